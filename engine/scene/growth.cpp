#include "engine/scene/growth.hpp"

#include <map>
#include <variant>

#include "engine/scene/content_weight.hpp"

namespace septet::scene {
namespace {

/// A geometry as it is by a command of the batch.
struct Size {
  std::uint64_t vertices = 0, polygons = 0;
  std::map<PartId, LayerType> layers;

  std::uint64_t bytes() const {
    std::uint64_t sum = shape_weight(vertices, polygons);
    for (const auto& [id, type] : layers)
      sum += std::uint64_t{4} * layer_width(type) * (is_vertex_layer(type) ? vertices : polygons);
    return sum;
  }
};

Size size_in(const Store& store, NodeId id) {
  Size size;
  const Node* node = store.find(id);
  const auto* geometry = node ? std::get_if<GeometryData>(&node->data) : nullptr;
  if (!geometry) return size;
  size.vertices = geometry->vertices_m.size();
  size.polygons = geometry->polygons.size();
  for (const auto& [layer, values] : geometry->layers) size.layers[layer] = values.type;
  return size;
}

}  // namespace

std::uint64_t grown_bytes(const Store& store, std::span<const Command> batch) {
  std::map<NodeId, Size> sizes;
  std::uint64_t grown = 0;
  const auto change = [&](NodeId node, const auto& how) {
    const auto [entry, added] = sizes.try_emplace(node);
    if (added) entry->second = size_in(store, node);
    const std::uint64_t before = entry->second.bytes();
    how(entry->second);
    const std::uint64_t after = entry->second.bytes();
    if (after > before) grown += after - before;
  };
  for (const Command& command : batch) {
    if (const auto* size = std::get_if<GeometrySizeSet>(&command))
      change(size->node, [&](Size& of) { of.vertices = size->vertices, of.polygons = size->polygons; });
    else if (const auto* layer = std::get_if<GeometryLayerSet>(&command))
      change(layer->node, [&](Size& of) { of.layers[layer->layer] = layer->type; });
    else if (const auto* destroyed = std::get_if<NodeDestroy>(&command))
      sizes[destroyed->node] = {};
  }
  return grown;
}

}  // namespace septet::scene
