#include "engine/scene/builder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "engine/core/check.hpp"
#include "engine/scene/part_role.hpp"

namespace septet::scene {
namespace {

constexpr std::size_t run_length = 16384;  ///< Vertices, polygons or tiles in one command.
constexpr PartId draw_group = 0, surface_group = 1, image_group = 0;
constexpr float uv_steps = 4096.0f;

float rounded(float value, float step) { return std::nearbyint(value / step) * step; }

float position_step(const geometry::PolygonMesh& mesh, double wanted_m) {
  if (wanted_m > 0.0) return static_cast<float>(std::exp2(std::floor(std::log2(wanted_m))));
  float extent_m = 0.0f;
  for (const glm::vec3& v : mesh.vertices_m)
    extent_m = std::max({extent_m, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  const float wanted = std::floor(std::log2(std::max(extent_m, 1e-6f) / 30000.0f));
  return std::exp2(std::clamp(wanted, -14.0f, -10.0f));
}

template <class T, class Piece>
void in_runs(const std::vector<T>& values, std::size_t width, Piece piece) {
  for (std::size_t first = 0; first < values.size(); first += run_length * width) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first);
    const auto count = static_cast<std::ptrdiff_t>(std::min(run_length * width, values.size() - first));
    piece(static_cast<std::uint32_t>(first / width), std::vector<T>(begin, begin + count));
  }
}

template <class T>
std::vector<T> flat(const std::vector<std::array<T, 4>>& rows) {
  std::vector<T> values;
  values.reserve(rows.size() * 4);
  for (const auto& row : rows) values.insert(values.end(), row.begin(), row.end());
  return values;
}

}  // namespace

SceneBuilder::SceneBuilder(Store& store, std::function<void(const Command&)> applied)
    : store_(store), applied_(std::move(applied)) {}

void SceneBuilder::apply(const Command& command) {
  const auto done = store_.apply(command);
  SEPTET_CHECK(done.has_value(), "{}", done ? "" : describe(done.error()));
  if (applied_) applied_(command);
}

NodeId SceneBuilder::create(NodeType type, std::string_view name) {
  const NodeId id = store_.assign_id();
  apply(NodeCreate{id, type});
  if (!name.empty()) apply(NodeNameSet{id, std::string(name)});
  return id;
}

NodeId SceneBuilder::add_mesh(std::string_view name, const geometry::PolygonMesh& mesh, const MeshOptions& options) {
  const auto optional = [](std::size_t size, std::size_t full) { return size == 0 || size == full; };
  SEPTET_CHECK(optional(mesh.corner_uvs.size(), mesh.polygons.size()) &&
                   optional(mesh.second_corner_uvs.size(), mesh.polygons.size()) &&
                   optional(mesh.corner_colors.size(), mesh.polygons.size()) &&
                   optional(mesh.corner_tangents.size(), mesh.polygons.size()) &&
                   optional(mesh.polygon_materials.size(), mesh.polygons.size()) &&
                   optional(mesh.edge_creases.size(), mesh.polygons.size()) &&
                   optional(mesh.vertex_creases.size(), mesh.vertices_m.size()),
               "mesh {}: {} vertices, {} polygons, {} uvs, {} materials, {} and {} creases", name,
               mesh.vertices_m.size(), mesh.polygons.size(), mesh.corner_uvs.size(), mesh.polygon_materials.size(),
               mesh.edge_creases.size(), mesh.vertex_creases.size());
  const NodeId id = create(NodeType::geometry, name);
  if (options.subdivision_level > 0) {
    apply(TagGroupSet{id, draw_group, "draw"});
    apply(TagSet{id, draw_group, 0, {"subdivision_level", options.subdivision_level}});
  }
  apply(GeometrySizeSet{id, static_cast<std::uint32_t>(mesh.vertices_m.size()),
                        static_cast<std::uint32_t>(mesh.polygons.size())});

  const float step_m = position_step(mesh, options.position_step_m);
  std::vector<glm::vec3> positions_m = mesh.vertices_m;
  for (glm::vec3& p : positions_m) p = {rounded(p.x, step_m), rounded(p.y, step_m), rounded(p.z, step_m)};
  in_runs(positions_m, 1, [&](std::uint32_t first, std::vector<glm::vec3> run) {
    apply(VerticesSet{id, first, std::move(run)});
  });
  in_runs(mesh.polygons, 1, [&](std::uint32_t first, std::vector<PolygonCorners> run) {
    for (const PolygonCorners& corners : run)
      for (std::uint32_t k = 0; k < geometry::corner_count(corners); ++k)
        SEPTET_CHECK(corners[k] < positions_m.size(), "mesh {}: corner {} of {} vertices", name, corners[k],
                     positions_m.size());
    apply(PolygonsSet{id, first, std::move(run)});
  });

  PartId next_layer = 0;
  const auto add_integers = [&](const char* layer_name, LayerType type, std::uint32_t default_value,
                                const std::vector<std::uint32_t>& values) {
    const PartId layer = next_layer++;
    apply(GeometryLayerSet{id, layer, layer_name, type, default_value, 0.0f});
    in_runs(values, layer_width(type), [&](std::uint32_t first, std::vector<std::uint32_t> run) {
      apply(LayerIntegersSet{id, layer, first, std::move(run)});
    });
  };
  const auto add_uvs = [&](const std::vector<std::array<glm::vec2, 4>>& uvs, const std::array<const char*, 2>& names) {
    if (uvs.empty()) return;
    for (const int axis : {0, 1}) {
      const PartId layer = next_layer++;
      apply(GeometryLayerSet{id, layer, names[static_cast<std::size_t>(axis)], LayerType::corner_real, 0, 0.0f});
      std::vector<float> values;
      values.reserve(uvs.size() * 4);
      for (const auto& corners : uvs)
        for (const glm::vec2& uv : corners) values.push_back(rounded(uv[axis], 1.0f / uv_steps));
      in_runs(values, 4, [&](std::uint32_t first, std::vector<float> run) {
        apply(LayerRealsSet{id, layer, first, std::move(run)});
      });
    }
  };
  add_uvs(mesh.corner_uvs, {"map_u", "map_v"});
  add_uvs(mesh.second_corner_uvs, {"second_map_u", "second_map_v"});
  if (!mesh.corner_colors.empty())
    add_integers("color", LayerType::corner_integer, white_vertex, flat(mesh.corner_colors));
  if (!mesh.corner_tangents.empty()) add_integers("tangent", LayerType::corner_integer, 0, flat(mesh.corner_tangents));
  if (std::any_of(mesh.polygon_materials.begin(), mesh.polygon_materials.end(), [](auto m) { return m != 0; }))
    add_integers("material", LayerType::face_integer, 0, mesh.polygon_materials);
  Crease vertex_crease{"", mesh.default_vertex_crease}, edge_crease{"", mesh.default_edge_crease};
  if (!mesh.vertex_creases.empty()) {
    vertex_crease.layer = "vertex_crease";
    add_integers("vertex_crease", LayerType::vertex_integer, mesh.default_vertex_crease, mesh.vertex_creases);
  }
  if (!mesh.edge_creases.empty()) {
    edge_crease.layer = "edge_crease";
    add_integers("edge_crease", LayerType::corner_integer, mesh.default_edge_crease, flat(mesh.edge_creases));
  }
  if (vertex_crease != Crease{}) apply(CreaseSet{id, CreaseKind::vertex, vertex_crease});
  if (edge_crease != Crease{}) apply(CreaseSet{id, CreaseKind::edge, edge_crease});
  return id;
}

NodeId SceneBuilder::add_bitmap(std::string_view name, std::uint32_t width, std::uint32_t height,
                                std::span<const std::uint8_t> rgba, bool srgb, const ImageSampling& sampling) {
  SEPTET_CHECK(rgba.size() == std::size_t{width} * height * 4, "bitmap {}: {} bytes for {} x {}", name, rgba.size(),
               width, height);
  const NodeId id = create(NodeType::bitmap, name);
  if (!srgb || sampling != ImageSampling{}) apply(TagGroupSet{id, image_group, "image"});
  if (!srgb) apply(TagSet{id, image_group, 0, {"srgb", false}});
  if (sampling.clamps_u) apply(TagSet{id, image_group, 1, {"clamps_u", true}});
  if (sampling.clamps_v) apply(TagSet{id, image_group, 2, {"clamps_v", true}});
  if (sampling.sharp) apply(TagSet{id, image_group, 3, {"sharp", true}});
  apply(BitmapSizeSet{id, width, height, 1});
  bool opaque = true;
  for (std::size_t i = 3; i < rgba.size(); i += 4) opaque = opaque && rgba[i] == 255;
  const std::size_t columns = tile_columns(width);
  const std::size_t tiles = tile_count(width, height, 1);
  const PartId channels = opaque ? 3 : 4;
  for (PartId channel = 0; channel < channels; ++channel) {
    constexpr std::array<const char*, 4> names = {"color_r", "color_g", "color_b", "alpha"};
    apply(BitmapLayerSet{id, channel, names[channel], PixelType::byte});
    std::vector<std::uint8_t> bytes(tiles * tile_bytes(PixelType::byte), 0);
    for (std::uint32_t y = 0; y < height; ++y)
      for (std::uint32_t x = 0; x < width; ++x) {
        const std::size_t tile = (y / tile_side) * columns + x / tile_side;
        bytes[tile * 64 + (y % tile_side) * tile_side + x % tile_side] =
            rgba[(std::size_t{y} * width + x) * 4 + channel];
      }
    constexpr std::size_t run_tiles = 1024;
    for (std::size_t first = 0; first < tiles; first += run_tiles) {
      const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(first * 64);
      const auto count = static_cast<std::ptrdiff_t>(std::min(run_tiles, tiles - first) * 64);
      apply(BitmapTilesSet{id, channel, static_cast<std::uint32_t>(first), {begin, begin + count}});
    }
  }
  return id;
}

void shine_by_picture(MaterialParameters& material) {
  material.maps[SurfaceMap::emission] = material.base_color_bitmap;
  material.emission *= material.base_color;
}

NodeId SceneBuilder::add_material(std::string_view name, const MaterialParameters& parameters) {
  const NodeId id = create(NodeType::material, name);
  FragmentId next = 0;
  const auto add = [&](Fragment fragment) {
    apply(FragmentSet{id, next, std::move(fragment)});
    return next++;
  };
  const auto blend = [&](BlendKind kind, FragmentId a, FragmentId b) {
    return add(BlenderFragment{kind, a, b, no_fragment});
  };

  FragmentId surface = add(ColorFragment{parameters.base_color});
  if (parameters.base_color_bitmap != no_node) {
    const FragmentId mapping = add(GeometryFragment{"map_u", "map_v", ""});
    const FragmentId image =
        add(TextureFragment{parameters.base_color_bitmap, "color_r", "color_g", "color_b", true, mapping});
    surface = blend(BlendKind::multiply, surface, image);
  }
  surface = blend(BlendKind::multiply, surface, add(LightFragment{}));
  if (parameters.opacity < 1.0f) {
    const FragmentId through = add(TransparencyFragment{1.0f, parameters.refraction_index});
    const FragmentId control = add(ColorFragment{glm::vec3(1.0f - parameters.opacity)});
    surface = add(BlenderFragment{BlendKind::fade, surface, through, control});
  }
  if (parameters.emission != glm::vec3(0.0f))
    surface = blend(BlendKind::add, surface, add(ColorFragment{parameters.emission}));
  add(OutputFragment{"color", surface, no_fragment});

  apply(TagGroupSet{id, surface_group, "surface"});
  PartId tag = 0;
  apply(TagSet{id, surface_group, tag++, {"roughness", double{parameters.roughness}}});
  apply(TagSet{id, surface_group, tag++, {"metallic", double{parameters.metallic}}});
  if (parameters.takes_paint) apply(TagSet{id, surface_group, tag++, {"takes_paint", true}});
  if (parameters.wettable) apply(TagSet{id, surface_group, tag++, {"wettable", true}});
  if (parameters.stripe) apply(TagSet{id, surface_group, tag++, {"stripe", true}});
  if (parameters.retroreflection != 0.0f)
    apply(TagSet{id, surface_group, tag++, {"retroreflection", double{parameters.retroreflection}}});
  if (parameters.picture_columns != 1)
    apply(TagSet{id, surface_group, tag++, {"picture_columns", parameters.picture_columns}});
  if (parameters.picture_rows != 1) apply(TagSet{id, surface_group, tag++, {"picture_rows", parameters.picture_rows}});
  if (parameters.share_of_sky != 1.0f)
    apply(TagSet{id, surface_group, tag++, {"share_of_sky", double{parameters.share_of_sky}}});
  if (parameters.clear_coat != 0.0f)
    apply(TagSet{id, surface_group, tag++, {"clear_coat", double{parameters.clear_coat}}});
  if (parameters.two_sided) apply(TagSet{id, surface_group, tag++, {"two_sided", true}});
  if (parameters.ambient_share != 1.0f)
    apply(TagSet{id, surface_group, tag++, {"ambient_share", double{parameters.ambient_share}}});
  if (parameters.lit_by_night) apply(TagSet{id, surface_group, tag++, {"lit_by_night", true}});
  if (parameters.in_street) apply(TagSet{id, surface_group, tag++, {"in_street", true}});
  for (std::size_t map = 0; map < surface_map_count; ++map)
    if (const NodeId bitmap = parameters.maps.values[map]; bitmap != no_node)
      apply(TagSet{id, surface_group, tag++, {surface_map_tags[map], NodeReference{bitmap}}});
  if (parameters.by_second_uv != 0) apply(TagSet{id, surface_group, tag++, {"by_second_uv", parameters.by_second_uv}});
  return id;
}

std::string SceneBuilder::unused_name(std::string name) {
  const std::uint32_t number = ++used_names_[name];
  if (number > 1) name += fmt::format("/{}", number);
  return name;
}

NodeId SceneBuilder::add_object(std::string_view name, const ObjectParameters& parameters) {
  const NodeId id = create(NodeType::object, name);
  apply(TransformSet{
      id, {parameters.parent_from_object.position_m, parameters.parent_from_object.orientation, parameters.scale}});
  PartId link = 0;
  if (parameters.geometry != no_node) apply(LinkSet{id, link++, {"geometry", parameters.geometry, 0}});
  for (std::size_t i = 0; i < parameters.materials.size(); ++i)
    apply(LinkSet{id, link++, {"material", parameters.materials[i], static_cast<std::uint32_t>(i)}});

  const ObjectParameters usual;
  std::vector<Tag> tags;
  if (parameters.visible_from_m != usual.visible_from_m) tags.push_back({"from_m", double{parameters.visible_from_m}});
  if (parameters.visible_to_m != usual.visible_to_m) tags.push_back({"to_m", double{parameters.visible_to_m}});
  if (parameters.role != usual.role) tags.push_back({"role", std::string(name_of(parameters.role))});
  if (!parameters.casts_shadow) tags.push_back({"casts_shadow", false});
  if (!tags.empty()) apply(TagGroupSet{id, draw_group, "draw"});
  for (std::size_t i = 0; i < tags.size(); ++i) apply(TagSet{id, draw_group, static_cast<PartId>(i), tags[i]});
  return id;
}

NodeId SceneBuilder::add_prototype(std::string_view model_name) {
  return create(NodeType::object, std::string(prototype_prefix).append(model_name));
}

void SceneBuilder::add_child(NodeId parent, NodeId child) {
  const Node* node = store_.find(parent);
  const auto* object = node ? std::get_if<ObjectData>(&node->data) : nullptr;
  SEPTET_CHECK(object, "node {} is no object", parent);
  const std::size_t free = object->links.empty() ? 0 : object->links.rbegin()->first + std::size_t{1};
  SEPTET_CHECK(free <= 0xFFFF, "object {} has too many links", parent);
  apply(LinkSet{parent, static_cast<PartId>(free), {"child", child, 0}});
}

}  // namespace septet::scene
