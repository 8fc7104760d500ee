/// Commands of geometries, materials and bitmaps.

#include "engine/scene/store_application.hpp"

namespace septet::scene {
namespace {

std::uint64_t layer_values(const GeometryData& geometry, LayerType type) {
  const std::size_t elements = is_vertex_layer(type) ? geometry.vertices_m.size() : geometry.polygons.size();
  return std::uint64_t{elements} * layer_width(type);
}

void fit(GeometryLayer& layer, const GeometryData& geometry) {
  const std::size_t values = layer_values(geometry, layer.type);
  if (is_real_layer(layer.type))
    layer.reals.resize(values, layer.default_real);
  else
    layer.integers.resize(values, layer.default_integer);
}

constexpr std::uint32_t largest_byte = 255;

}  // namespace

Expected<void> Store::Application::operator()(const GeometrySizeSet& c) const {
  const auto found = node_with<GeometryData>(c.node);
  if (!found) return tl::unexpected(found.error());
  if (c.vertices > store.limits_.vertices || c.polygons > store.limits_.polygons)
    return no("the geometry is too large", "divide it among several nodes");
  GeometryData& geometry = *found->second;
  std::uint64_t before = shape_weight(geometry.vertices_m.size(), geometry.polygons.size());
  std::uint64_t after = shape_weight(c.vertices, c.polygons);
  for (const auto& [id, layer] : geometry.layers) {
    before += 4 * layer_values(geometry, layer.type);
    after += std::uint64_t{4} * layer_width(layer.type) * (is_vertex_layer(layer.type) ? c.vertices : c.polygons);
  }
  if (auto ok = charge(before, after); !ok) return ok;
  geometry.vertices_m.resize(c.vertices, glm::vec3(0.0f));
  constexpr auto none = geometry::no_vertex;
  geometry.polygons.resize(c.polygons, PolygonCorners{none, none, none, none});
  for (auto& [id, layer] : geometry.layers) fit(layer, geometry);
  geometry.shape_revision = touch(*found->first);
  return {};
}

Expected<void> Store::Application::operator()(const GeometryLayerSet& c) const {
  const auto found = node_with<GeometryData>(c.node);
  if (!found) return tl::unexpected(found.error());
  if (c.layer >= base_polygon_layer) return no("the id is that of a base layer", "use an id below 65534");
  if (c.type == LayerType::face_byte && c.default_integer > largest_byte)
    return no("the default of a face_byte layer is over 255", "use a face_integer layer");
  GeometryData& geometry = *found->second;
  const auto existing = geometry.layers.find(c.layer);
  const bool keeps_values = existing != geometry.layers.end() && existing->second.type == c.type;
  GeometryLayer layer;
  const std::uint64_t after = container_bytes + c.name.size() + 4 * layer_values(geometry, c.type);
  if (auto ok = charge(existing == geometry.layers.end() ? 0 : weight(existing->second), after); !ok) return ok;
  if (keeps_values) layer = std::move(existing->second);
  layer.name = c.name;
  layer.type = c.type;
  layer.default_integer = c.default_integer;
  layer.default_real = c.default_real;
  fit(layer, geometry);
  layer.revision = touch(*found->first);
  geometry.layers.insert_or_assign(c.layer, std::move(layer));
  return {};
}

Expected<void> Store::Application::operator()(const GeometryLayerDestroy& c) const {
  const auto found = node_with<GeometryData>(c.node);
  if (!found) return tl::unexpected(found.error());
  destroy_part(*found->first, found->second->layers, c.layer);
  return {};
}

Expected<void> Store::Application::operator()(const VerticesSet& c) const {
  const auto found = node_with<GeometryData>(c.node);
  if (!found) return tl::unexpected(found.error());
  if (auto ok = copy_run(c.positions_m, c.first, found->second->vertices_m); !ok) return ok;
  found->second->shape_revision = touch(*found->first);
  return {};
}

Expected<void> Store::Application::operator()(const PolygonsSet& c) const {
  const auto found = node_with<GeometryData>(c.node);
  if (!found) return tl::unexpected(found.error());
  if (auto ok = copy_run(c.polygons, c.first, found->second->polygons); !ok) return ok;
  found->second->shape_revision = touch(*found->first);
  return {};
}

Expected<void> Store::Application::operator()(const LayerIntegersSet& c) const {
  const Node* owner = store.find(c.node);
  const auto* geometry = owner ? std::get_if<GeometryData>(&owner->data) : nullptr;
  if (geometry && geometry->layers.contains(c.layer) && geometry->layers.at(c.layer).type == LayerType::face_byte &&
      std::any_of(c.values.begin(), c.values.end(), [](std::uint32_t value) { return value > largest_byte; }))
    return no("a face_byte value is over 255", "use a face_integer layer");
  return set_layer_run(c, &GeometryLayer::integers, false);
}

Expected<void> Store::Application::operator()(const LayerRealsSet& c) const {
  return set_layer_run(c, &GeometryLayer::reals, true);
}

Expected<void> Store::Application::operator()(const CreaseSet& c) const {
  const auto found = node_with<GeometryData>(c.node);
  if (!found) return tl::unexpected(found.error());
  Crease& crease = c.kind == CreaseKind::vertex ? found->second->vertex_crease : found->second->edge_crease;
  crease = c.crease;
  touch(*found->first);
  return {};
}

Expected<void> Store::Application::operator()(const FragmentSet& c) const {
  const auto found = node_with<MaterialData>(c.node);
  if (!found) return tl::unexpected(found.error());
  if (c.fragment == no_fragment) return no("the id is out of range", "use an id below 65535");
  return set_part(*found->first, found->second->fragments, c.fragment, c.value);
}

Expected<void> Store::Application::operator()(const FragmentDestroy& c) const {
  const auto found = node_with<MaterialData>(c.node);
  if (!found) return tl::unexpected(found.error());
  destroy_part(*found->first, found->second->fragments, c.fragment);
  return {};
}

Expected<void> Store::Application::operator()(const BitmapSizeSet& c) const {
  const auto found = node_with<BitmapData>(c.node);
  if (!found) return tl::unexpected(found.error());
  const std::uint32_t side = store.limits_.bitmap_side;
  if (c.width > side || c.height > side || c.depth > side)
    return no(fmt::format("a side is longer than {} pixels", side), "divide the image");
  const std::uint64_t tiles = tile_count(c.width, c.height, c.depth);
  std::uint64_t before = 0, after = 0;
  for (const auto& [id, layer] : found->second->layers) {
    before += layer.tiles.size();
    after += tiles * tile_bytes(layer.type);
  }
  if (auto ok = charge(before, after); !ok) return ok;
  BitmapData& bitmap = *found->second;
  bitmap.width = c.width, bitmap.height = c.height, bitmap.depth = c.depth;
  const std::uint64_t revision = touch(*found->first);
  for (auto& [id, layer] : bitmap.layers) {
    layer.tiles.assign(tiles * tile_bytes(layer.type), 0);
    layer.revision = revision;
  }
  return {};
}

Expected<void> Store::Application::operator()(const BitmapLayerSet& c) const {
  const auto found = node_with<BitmapData>(c.node);
  if (!found) return tl::unexpected(found.error());
  BitmapData& bitmap = *found->second;
  const auto existing = bitmap.layers.find(c.layer);
  const bool keeps_values = existing != bitmap.layers.end() && existing->second.type == c.type;
  const std::uint64_t bytes = tile_count(bitmap.width, bitmap.height, bitmap.depth) * tile_bytes(c.type);
  if (auto ok = charge(existing == bitmap.layers.end() ? 0 : weight(existing->second),
                       container_bytes + c.name.size() + bytes);
      !ok)
    return ok;
  BitmapLayer& layer = bitmap.layers[c.layer];
  layer.name = c.name;
  layer.type = c.type;
  if (!keeps_values) layer.tiles.assign(bytes, 0);
  layer.revision = touch(*found->first);
  return {};
}

Expected<void> Store::Application::operator()(const BitmapLayerDestroy& c) const {
  const auto found = node_with<BitmapData>(c.node);
  if (!found) return tl::unexpected(found.error());
  destroy_part(*found->first, found->second->layers, c.layer);
  return {};
}

Expected<void> Store::Application::operator()(const BitmapTilesSet& c) const {
  const auto found = node_with<BitmapData>(c.node);
  if (!found) return tl::unexpected(found.error());
  const auto layer = found->second->layers.find(c.layer);
  if (layer == found->second->layers.end()) return no("there is no such layer", "create the layer first");
  const std::uint32_t size = tile_bytes(layer->second.type);
  if (c.tiles.size() % size != 0) return no("a tile is incomplete", "send whole tiles");
  if (auto ok = copy_run(c.tiles, std::uint64_t{c.first_tile} * size, layer->second.tiles); !ok) return ok;
  Node& node = *found->first;
  layer->second.revision = node.revision = node.drawn_revision = ++store.revision_;
  const auto tiles = static_cast<std::uint32_t>(c.tiles.size() / size);
  if (tiles > 0) store.changes_.add(node.revision, {node.id, c.layer, c.first_tile, tiles});
  return {};
}

}  // namespace septet::scene
