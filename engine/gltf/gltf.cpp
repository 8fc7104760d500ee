#include "engine/gltf/gltf.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>
#include <nlohmann/json.hpp>

#include "engine/core/printable.hpp"
#include "engine/gltf/accessors.hpp"
#include "engine/gltf/animation.hpp"
#include "engine/gltf/container.hpp"
#include "engine/gltf/extras.hpp"
#include "engine/gltf/looks.hpp"
#include "engine/gltf/morph.hpp"
#include "engine/gltf/nodes.hpp"
#include "engine/gltf/passed_over.hpp"
#include "engine/gltf/skin.hpp"
#include "engine/math/pose_keys.hpp"

namespace septet::gltf {
namespace {

/// glTF's x is left, y up, z forward; ours x forward, y left, z up.
glm::vec3 our_axes(const glm::vec3& p) { return {p.z, p.x, p.y}; }

/// Joins vertices of the same place and normal.
struct Corner {
  std::array<float, 6> numbers;
  bool operator==(const Corner&) const = default;
};
struct CornerHash {
  std::size_t operator()(const Corner& corner) const {
    std::size_t hash = 0;
    for (const float number : corner.numbers) hash = hash * 1000003u ^ std::hash<float>{}(number);
    return hash;
  }
};

/// A part under construction.
struct Growing {
  Part part;
  std::unordered_map<Corner, std::uint32_t, CornerHash> known;
  bool has_uvs = false;
};

/// Where a node's contents go.
struct Place {
  std::size_t part = 0;
  glm::mat4 part_from_parent{1.0f};  ///< Of a part with keys.
};

/// Triangles of a primitive as its own vertices (glTF 2.0, 3.7.2.1), in the winding of each mode.
std::vector<std::array<std::uint32_t, 3>> triangles_of(const std::vector<std::uint32_t>& indices, std::int64_t mode) {
  constexpr std::int64_t list = 4, strip = 5, fan = 6;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  const std::size_t count = indices.size();
  if (mode == list)
    for (std::size_t i = 0; i + 2 < count; i += 3) triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
  for (std::size_t i = 0; i + 2 < count; ++i) {
    if (mode == strip) triangles.push_back({indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]});
    if (mode == fan) triangles.push_back({indices[i + 1], indices[i + 2], indices[0]});
  }
  return triangles;
}

class Reader {
 public:
  Reader(const Container& container, const std::function<bool(std::string_view)>& begins_part)
      : container_(container), begins_part_(begins_part), nodes_(list_of(*container.json, "nodes")) {}

  Expected<Model> read() {
    if (auto known = check_required_extensions(container_); !known) return tl::unexpected(known.error());
    if (auto looks = read_looks(container_, model_); !looks) return tl::unexpected(looks.error());
    growing_.emplace_back();
    auto placed = place_nodes(container_);
    if (!placed) return tl::unexpected(placed.error());
    placed_ = std::move(*placed);
    auto animations = read_animations(container_, model_.left_out);
    if (!animations) return tl::unexpected(animations.error());
    animations_ = std::move(*animations);
    for (const std::int64_t root : placed_.roots)
      if (auto added = add_node(root, {}); !added) return tl::unexpected(added.error());
    finish();
    if (model_.parts.empty())
      return failure("it has no triangle in its scene", container_.where, "export what is to be seen");
    return std::move(model_);
  }

 private:
  std::string node_place(std::int64_t index) const { return fmt::format("{}, node {}", container_.where, index); }

  /// `index`: a placed node's.
  Expected<void> add_node(std::int64_t index, Place place) {
    const Json& node = nodes_[static_cast<std::size_t>(index)];
    add_extras(node, model_.extras, model_.left_out);
    chain_.push_back(index);
    const glm::mat4& model_from_node = *placed_.model_from_node[static_cast<std::size_t>(index)];
    place.part_from_parent = place.part_from_parent * parent_from_node(node);
    const std::string name = text_in(node, "name");
    const bool is_animated = animations_.by_node.contains(index);
    if (!name.empty() && begins_part_(name)) {
      if (growing_.size() >= most_parts)
        return failure(fmt::format("more than {} parts begin", most_parts), node_place(index), "join some");
      if (is_animated || !growing_[place.part].part.keys.empty()) unmoved_.insert(printable(name, 80));
      place.part = growing_.size();
      growing_.emplace_back();
      growing_.back().part.name = name;
      const glm::vec3 origin = our_axes(glm::vec3(model_from_node[3]));
      if (!is_near(origin)) return far_away(index);
      growing_.back().part.origin_m = origin;
    } else if (is_animated && has_rigid_mesh(node)) {
      if (auto begun = begin_moving(index, place); !begun) return begun;
    }
    if (node.is_object() && node.contains("mesh"))
      if (auto added = add_mesh(index_in(node, "mesh"), index, model_from_node, place); !added) return added;
    for (const Json& child : list_of(node, "children"))
      if (auto added = add_node(node_index(*container_.json, child), place); !added) return added;
    chain_.pop_back();
    return {};
  }

  /// True if the node, or one below it that no animation moves itself, has a mesh that no joints place.
  bool has_rigid_mesh(const Json& node) const {
    if (node.is_object() && node.contains("mesh") && !node.contains("skin")) return true;
    const Json& children = list_of(node, "children");
    return std::ranges::any_of(children, [&](const Json& child) {
      const std::int64_t index = node_index(*container_.json, child);
      return !animations_.by_node.contains(index) && has_rigid_mesh(nodes_[static_cast<std::size_t>(index)]);
    });
  }

  /// A part that moves by the animation of the last node of the chain and of those above it.
  Expected<void> begin_moving(std::int64_t node, Place& place) {
    constexpr std::size_t most_poses = 1'000'000;
    if (const std::string& role = growing_[place.part].part.name; !role.empty()) {
      unmoved_.insert(printable(role, 80));
      return {};
    }
    if (growing_.size() >= most_parts || poses_ > most_poses) {
      moves_too_much_ = true;
      place.part = 0;
      return {};
    }
    place = {growing_.size(), glm::mat4(1.0f)};
    Growing& growing = growing_.emplace_back();
    growing.part.keys = keys_of_chain(container_, animations_, chain_);
    poses_ += growing.part.keys.size() * chain_.size();
    float largest = 0.0f;
    for (PoseKey& key : growing.part.keys) {
      key.position_m = our_axes(key.position_m);
      key.rotation = glm::quat(key.rotation.w, our_axes({key.rotation.x, key.rotation.y, key.rotation.z}));
      key.scale = our_axes(key.scale);
      if (!is_near(key.position_m)) return far_away(node);
      for (int i = 0; i < 3; ++i) largest = std::max(largest, std::abs(key.scale[i]));
    }
    if (!(largest > 0.0f)) return {};

    for (PoseKey& key : growing.part.keys) key.scale /= largest;
    place.part_from_parent = glm::mat4(glm::mat3(largest));
    return {};
  }

  static bool is_near(const glm::vec3& p) {
    return std::abs(p.x) <= furthest_m && std::abs(p.y) <= furthest_m && std::abs(p.z) <= furthest_m;
  }
  tl::unexpected<Error> far_away(std::int64_t node) const {
    return failure(fmt::format("it lies further than {:.0f} m from the origin", furthest_m), node_place(node),
                   "give the model's lengths in metres and its place around the origin");
  }

  Expected<void> add_mesh(std::int64_t mesh, std::int64_t node, const glm::mat4& model_from_node, const Place& place) {
    const Json& meshes = list_of(*container_.json, "meshes");
    if (mesh < 0 || static_cast<std::uint64_t>(mesh) >= meshes.size())
      return failure(fmt::format("its mesh is none of the file's {}", meshes.size()), node_place(node), export_anew);
    std::optional<Skin> skin;
    if (const Json& json = nodes_[static_cast<std::size_t>(node)]; json.contains("skin")) {
      auto read = read_skin(container_, index_in(json, "skin"), placed_, node_place(node));
      if (!read) return tl::unexpected(read.error());
      skin = std::move(*read);
      const Json& skin_json = list_of(*container_.json, "skins")[static_cast<std::size_t>(index_in(json, "skin"))];
      if (const Json& joints = list_of(skin_json, "joints"); std::ranges::any_of(joints, [&](const Json& joint) {
            return animations_.by_node.contains(node_index(*container_.json, joint));
          }))
        bent_.insert(mesh);
    }
    const bool has_keys = !growing_[place.part].part.keys.empty();
    // The joints alone place a skinned mesh (3.7.3.3).
    const glm::mat4 model_from_mesh = skin ? glm::mat4(1.0f) : has_keys ? place.part_from_parent : model_from_node;
    Growing& growing = growing_[skin && has_keys ? 0 : place.part];
    for (const Json& primitive : list_of(meshes[static_cast<std::size_t>(mesh)], "primitives"))
      if (auto added = add_primitive(primitive, mesh, node, model_from_mesh, skin ? &*skin : nullptr, growing); !added)
        return added;
    return {};
  }

  Expected<void> add_primitive(const Json& primitive, std::int64_t mesh, std::int64_t node,
                               const glm::mat4& model_from_node, const Skin* skin, Growing& growing) {
    constexpr std::int64_t triangle_list = 4, triangle_fan = 6;
    const std::int64_t mode = index_in(primitive, "mode", triangle_list);
    if (mode < triangle_list || mode > triangle_fan) return {};  // Points and lines are not drawn.
    static const Json none = Json::object();
    const Json& attributes = primitive.contains("attributes") ? primitive["attributes"] : none;
    auto positions = read_rows(container_, index_in(attributes, "POSITION"), 3, 3, most_vertices);
    if (!positions) return tl::unexpected(positions.error());
    const auto optional_rows = [&](const char* name, std::size_t least, std::size_t most) -> Expected<Rows> {
      if (!attributes.contains(name)) return Rows{};
      auto rows = read_rows(container_, index_in(attributes, name), least, most, most_vertices);
      if (rows && rows->count != positions->count)
        return failure(fmt::format("{} has {} rows and POSITION {}", name, rows->count, positions->count),
                       node_place(node), export_anew);
      return rows;
    };
    auto normals = optional_rows("NORMAL", 3, 3);
    if (!normals) return tl::unexpected(normals.error());
    const std::vector<float> weights = weights_of(nodes_[static_cast<std::size_t>(node)],
                                                  list_of(*container_.json, "meshes")[static_cast<std::size_t>(mesh)]);
    if (auto added = add_targets(container_, primitive, weights, *positions, *normals, node_place(node)); !added)
      return added;
    const auto colours = optional_rows("COLOR_0", 3, 4);
    if (!colours) return tl::unexpected(colours.error());
    std::vector<std::uint32_t> indices;
    if (primitive.contains("indices")) {
      auto read = read_indices(container_, index_in(primitive, "indices"), 3 * most_triangles, positions->count);
      if (!read) return tl::unexpected(read.error());
      indices = std::move(*read);
    } else {
      for (std::uint32_t i = 0; i < positions->count; ++i) indices.push_back(i);
    }
    auto triangles = triangles_of(indices, mode);
    if (skin) {
      const auto mirrors = place_by_skin(container_, attributes, *skin, *positions, node_place(node));
      if (!mirrors) return tl::unexpected(mirrors.error());
      if (*mirrors)
        for (auto& triangle : triangles) std::swap(triangle[1], triangle[2]);
    }
    triangles_ += triangles.size();
    vertices_ += positions->count + indices.size();
    if (triangles_ > most_triangles || vertices_ > 6 * most_vertices)
      return failure(fmt::format("it draws more than {} triangles", most_triangles), container_.where,
                     "make the model of fewer triangles");
    const std::int64_t material = index_in(primitive, "material", static_cast<std::int64_t>(model_.looks.size()) - 1);
    if (material < 0 || static_cast<std::uint64_t>(material) >= model_.looks.size())
      return failure("its material is none of the file's", node_place(node), export_anew);
    const Look& look = model_.looks[static_cast<std::size_t>(material)];
    const std::string uv_set = fmt::format("TEXCOORD_{}", look.mapping.uv_set);
    const auto uvs = optional_rows(uv_set.c_str(), 2, 2);
    if (!uvs) return tl::unexpected(uvs.error());
    if (look.has_picture() && !triangles.empty() && !attributes.contains(uv_set)) unmapped_[material].insert(mesh);
    return add_triangles(triangles, *positions, *normals, *uvs, look_of(static_cast<std::size_t>(material), *colours),
                         node, model_from_node, growing);
  }

  /// The material in the mean of a primitive's vertex colours, where it has some.
  std::uint32_t look_of(std::size_t material, const Rows& colours) {
    if (colours.count == 0) return static_cast<std::uint32_t>(material);
    glm::dvec3 sum(0.0), least(1.0), most(0.0);
    for (std::size_t i = 0; i < colours.count; ++i) {
      const float* c = &colours.numbers[i * colours.width];
      const glm::dvec3 colour(c[0], c[1], c[2]);
      sum += colour;
      least = glm::min(least, colour);
      most = glm::max(most, colour);
    }
    constexpr double seen = 0.02;
    if (glm::any(glm::greaterThan(most - least, glm::dvec3(seen)))) many_coloured_.insert(model_.looks[material].name);
    const glm::dvec3 mean = glm::clamp(sum / static_cast<double>(colours.count), 0.0, 1.0);
    // In steps of a hundredth: parts of one colour share one look.
    const auto hundredths = [](double share) { return static_cast<int>(std::lround(share * 100.0)); };
    const std::array<int, 4> key{static_cast<int>(material), hundredths(mean.x), hundredths(mean.y),
                                 hundredths(mean.z)};
    const auto [known, is_new] = coloured_.try_emplace(key, static_cast<std::uint32_t>(model_.looks.size()));
    if (is_new) {
      if (coloured_.size() > most_materials) return static_cast<std::uint32_t>(material);
      Look look = model_.looks[material];
      look.base_color *= glm::vec3(mean);
      model_.looks.push_back(std::move(look));
    }
    return std::min(known->second, static_cast<std::uint32_t>(model_.looks.size() - 1));
  }

  Expected<void> add_triangles(const std::vector<std::array<std::uint32_t, 3>>& triangles, const Rows& positions,
                               const Rows& normals, const Rows& uvs, std::uint32_t look, std::int64_t node,
                               const glm::mat4& model_from_node, Growing& growing) {
    const glm::mat3 turn(model_from_node);
    const bool mirrors = glm::determinant(turn) < 0.0f;
    geometry::PolygonMesh& mesh = growing.part.mesh;
    std::vector<std::uint32_t> placed(positions.count, geometry::no_vertex);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      geometry::PolygonCorners corners{0, 0, 0, geometry::no_vertex};
      std::array<glm::dvec2, 3> file_uvs{};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = triangles[t][mirrors ? 2 - k : k];
        if (uvs.count > 0)
          file_uvs[k] = model_.looks[look].mapping({uvs.numbers[vertex * 2], uvs.numbers[vertex * 2 + 1]});
        if (placed[vertex] == geometry::no_vertex || normals.count == 0) {
          const float* p = &positions.numbers[std::size_t{vertex} * 3];
          const glm::vec3 at = our_axes(glm::vec3(model_from_node * glm::vec4(p[0], p[1], p[2], 1.0f)));
          if (!is_near(at)) return far_away(node);
          // Without normals every triangle is flat (3.7.2.1): its number stands for the normal, and joins nothing.
          glm::vec3 normal(static_cast<float>(t), static_cast<float>(mesh.polygons.size()), -2.0f);
          if (normals.count > 0) {
            const float* n = &normals.numbers[std::size_t{vertex} * 3];
            normal = {n[0], n[1], n[2]};
          }
          const glm::vec3 here = at - growing.part.origin_m;
          const Corner corner{{here.x, here.y, here.z, normal.x, normal.y, normal.z}};
          const auto [known, is_new] =
              growing.known.try_emplace(corner, static_cast<std::uint32_t>(mesh.vertices_m.size()));
          if (is_new) mesh.vertices_m.push_back(here);
          placed[vertex] = known->second;
        }
        corners[k] = placed[vertex];
      }
      if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
      mesh.polygons.push_back(corners);
      mesh.polygon_materials.push_back(look);
      mesh.corner_uvs.push_back(near_origin(file_uvs, model_.looks[look]));
      growing.has_uvs |= uvs.count > 0;
    }
    return {};
  }

  /// Where pictures repeat, far coordinates would lose their digits, so the whole triangle is moved by whole pictures.
  static std::array<glm::vec2, 4> near_origin(const std::array<glm::dvec2, 3>& uvs, const Look& look) {
    constexpr double far = 64.0;
    const bool is_far = glm::any(glm::greaterThan(glm::abs(uvs[0]), glm::dvec2(far)));
    const glm::dvec2 moved = is_far ? glm::floor(uvs[0]) : glm::dvec2(0.0);
    const glm::dvec2 whole(look.ends_u ? 0.0 : moved.x, look.ends_v ? 0.0 : moved.y);
    return {uvs[0] - whole, uvs[1] - whole, uvs[2] - whole, glm::vec2(0.0f)};
  }

  /// The mesh's name, or its number where it has none.
  std::string mesh_name(std::int64_t mesh) const {
    const std::string name =
        printable(text_in(list_of(*container_.json, "meshes")[static_cast<std::size_t>(mesh)], "name"), 80);
    return name.empty() ? fmt::format("mesh {}", mesh) : fmt::format("mesh \"{}\"", name);
  }

  /// One sentence a material, however many meshes it is.
  void report_unmapped() {
    for (const auto& [material, meshes] : unmapped_) {
      const Look& look = model_.looks[static_cast<std::size_t>(material)];
      model_.left_out.push_back(
          fmt::format("material \"{}\" lays its picture by TEXCOORD_{}, which {}{} does not have: one colour of the "
                      "picture is seen there",
                      look.name, look.mapping.uv_set, mesh_name(*meshes.begin()),
                      meshes.size() > 1 ? fmt::format(", one of {} such meshes,", meshes.size()) : ""));
    }
  }

  void report_unmoved() {
    if (!bent_.empty())
      model_.left_out.push_back(fmt::format(
          "{}{} is bent by joints, whose animation is not played: it stands as they "
          "do in the file",
          mesh_name(*bent_.begin()), bent_.size() > 1 ? fmt::format(" (and {} more)", bent_.size() - 1) : ""));
    for (const std::string& name : unmoved_)
      model_.left_out.push_back(fmt::format("node \"{}\" moves by its name, and no animation moves it", name));
    if (moves_too_much_)
      model_.left_out.push_back(
          fmt::format("more than {} parts are animated: the others stand as they do in the file", most_parts));
  }

  void finish() {
    for (std::string& sentence : passed_over(container_)) model_.left_out.push_back(std::move(sentence));
    report_unmapped();
    report_unmoved();
    for (const std::string& material : many_coloured_)
      model_.left_out.push_back(
          fmt::format("material \"{}\" lies on vertices of several colours, of which the mean is drawn", material));
    for (Growing& growing : growing_) {
      Part& part = growing.part;
      if (part.mesh.polygons.empty()) continue;
      if (!growing.has_uvs) part.mesh.corner_uvs.clear();
      for (const glm::vec3& p : part.mesh.vertices_m) {
        const glm::vec3 at = part.keys.empty() ? part.origin_m + p
                                               : part.keys.front().position_m +
                                                     part.keys.front().rotation * (part.keys.front().scale * p);
        model_.least_m = bounded_ ? glm::min(model_.least_m, at) : at;
        model_.most_m = bounded_ ? glm::max(model_.most_m, at) : at;
        bounded_ = true;
      }
      model_.parts.push_back(std::move(part));
    }
  }

  const Container& container_;
  const std::function<bool(std::string_view)>& begins_part_;
  const Json& nodes_;
  PlacedNodes placed_;
  Animations animations_;
  std::vector<std::int64_t> chain_;  ///< From the root to the node that is read.
  std::size_t poses_ = 0;            ///< Computed of animated nodes.
  bool moves_too_much_ = false;
  std::set<std::int64_t> bent_;    ///< Skinned meshes whose joints are animated.
  std::set<std::string> unmoved_;  ///< Parts that move by their name, and would by an animation.
  Model model_;
  std::vector<Growing> growing_;
  std::map<std::array<int, 4>, std::uint32_t> coloured_;
  std::map<std::int64_t, std::set<std::int64_t>> unmapped_;  ///< Meshes without their material's texture coordinates.
  std::set<std::string> many_coloured_;                      ///< Materials on vertices of several colours.
  std::size_t triangles_ = 0, vertices_ = 0;
  bool bounded_ = false;
};

}  // namespace

glm::dvec2 PictureMapping::operator()(const glm::dvec2& uv) const {
  const glm::dvec2 scaled = scale * uv;
  const double cosine = std::cos(rotation_rad), sine = std::sin(rotation_rad);
  const glm::dvec2 turned(cosine * scaled.x + sine * scaled.y, cosine * scaled.y - sine * scaled.x);
  return share * (offset + turned);
}

Expected<Model> read_gltf(std::string_view bytes, std::string_view where,
                          const std::function<bool(std::string_view)>& begins_part) {
  auto container = open_container(bytes, where);
  if (!container) return tl::unexpected(container.error());
  return Reader(*container, begins_part).read();
}

}  // namespace septet::gltf
