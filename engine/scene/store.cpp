#include "engine/scene/store.hpp"

#include <algorithm>

namespace septet::scene {
namespace {

using Emit = std::function<void(Command)>;

/// Calls `piece(first, count)` for runs of at most `most` elements.
template <class Piece>
void in_runs(std::size_t elements, std::size_t most, Piece piece) {
  for (std::size_t first = 0; first < elements; first += most)
    piece(static_cast<std::uint32_t>(first), std::min(most, elements - first));
}

template <class T>
std::vector<T> slice(const std::vector<T>& values, std::size_t first, std::size_t count) {
  const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

void describe(NodeId id, const ObjectData& object, const Emit& emit, std::size_t) {
  if (object.transform != Transform{}) emit(TransformSet{id, object.transform});
  if (object.motion != Motion{}) emit(MotionSet{id, object.motion});
  for (const auto& [link, value] : object.links) emit(LinkSet{id, link, value});
  if (object.hidden) emit(HideSet{id, true});
}

void describe(NodeId id, const GeometryData& geometry, const Emit& emit, std::size_t run) {
  if (!geometry.vertices_m.empty() || !geometry.polygons.empty())
    emit(GeometrySizeSet{id, static_cast<std::uint32_t>(geometry.vertices_m.size()),
                         static_cast<std::uint32_t>(geometry.polygons.size())});
  if (geometry.vertex_crease != Crease{}) emit(CreaseSet{id, CreaseKind::vertex, geometry.vertex_crease});
  if (geometry.edge_crease != Crease{}) emit(CreaseSet{id, CreaseKind::edge, geometry.edge_crease});
  in_runs(geometry.vertices_m.size(), std::max<std::size_t>(1, run / 3), [&](std::uint32_t first, std::size_t count) {
    emit(VerticesSet{id, first, slice(geometry.vertices_m, first, count)});
  });
  in_runs(geometry.polygons.size(), std::max<std::size_t>(1, run / 4), [&](std::uint32_t first, std::size_t count) {
    emit(PolygonsSet{id, first, slice(geometry.polygons, first, count)});
  });
  for (const auto& entry : geometry.layers) {
    const PartId layer_id = entry.first;
    const GeometryLayer& layer = entry.second;
    emit(GeometryLayerSet{id, layer_id, layer.name, layer.type, layer.default_integer, layer.default_real});
    const std::size_t width = layer_width(layer.type);
    const std::size_t elements = (layer.integers.size() + layer.reals.size()) / width;
    in_runs(elements, std::max<std::size_t>(1, run / width), [&](std::uint32_t first, std::size_t count) {
      if (is_real_layer(layer.type))
        emit(LayerRealsSet{id, layer_id, first, slice(layer.reals, first * width, count * width)});
      else
        emit(LayerIntegersSet{id, layer_id, first, slice(layer.integers, first * width, count * width)});
    });
  }
}

void describe(NodeId id, const MaterialData& material, const Emit& emit, std::size_t) {
  for (const auto& [fragment, value] : material.fragments) emit(FragmentSet{id, fragment, value});
}

void describe(NodeId id, const BitmapData& bitmap, const Emit& emit, std::size_t run) {
  if (bitmap.width != 0 || bitmap.height != 0 || bitmap.depth != 1)
    emit(BitmapSizeSet{id, bitmap.width, bitmap.height, bitmap.depth});
  for (const auto& entry : bitmap.layers) {
    const PartId layer_id = entry.first;
    const BitmapLayer& layer = entry.second;
    emit(BitmapLayerSet{id, layer_id, layer.name, layer.type});
    const std::size_t size = tile_bytes(layer.type);
    in_runs(layer.tiles.size() / size, std::max<std::size_t>(1, run / size),
            [&](std::uint32_t first, std::size_t count) {
              emit(BitmapTilesSet{id, layer_id, first, slice(layer.tiles, first * size, count * size)});
            });
  }
}

// ---- comparison: everything but revisions

bool same(const TagGroup& a, const TagGroup& b) { return a.name == b.name && a.tags == b.tags; }
bool same(const GeometryLayer& a, const GeometryLayer& b) {
  return a.name == b.name && a.type == b.type && a.default_integer == b.default_integer &&
         a.default_real == b.default_real && a.integers == b.integers && a.reals == b.reals;
}
bool same(const BitmapLayer& a, const BitmapLayer& b) {
  return a.name == b.name && a.type == b.type && a.tiles == b.tiles;
}
template <class Parts>
bool same_parts(const Parts& a, const Parts& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& x, const auto& y) { return x.first == y.first && same(x.second, y.second); });
}
bool same(const ObjectData& a, const ObjectData& b) {
  return a.transform == b.transform && a.motion == b.motion && a.links == b.links && a.hidden == b.hidden;
}
bool same(const GeometryData& a, const GeometryData& b) {
  return a.vertices_m == b.vertices_m && a.polygons == b.polygons && same_parts(a.layers, b.layers) &&
         a.vertex_crease == b.vertex_crease && a.edge_crease == b.edge_crease;
}
bool same(const MaterialData& a, const MaterialData& b) { return a.fragments == b.fragments; }
bool same(const BitmapData& a, const BitmapData& b) {
  return a.width == b.width && a.height == b.height && a.depth == b.depth && same_parts(a.layers, b.layers);
}

}  // namespace

const Node* Store::find(NodeId id) const {
  const auto found = nodes_.find(id);
  return found == nodes_.end() ? nullptr : &found->second;
}

const Node* Store::find(NodeType type, std::string_view name) const {
  for (const auto& [id, node] : nodes_)
    if (node.type() == type && node.name == name) return &node;
  return nullptr;
}

void describe_node(const Node& node, const Emit& emit, std::size_t run_values) {
  emit(NodeCreate{node.id, node.type()});
  if (!node.name.empty()) emit(NodeNameSet{node.id, node.name});
  for (const auto& [group_id, group] : node.tag_groups) {
    emit(TagGroupSet{node.id, group_id, group.name});
    for (const auto& [tag_id, tag] : group.tags) emit(TagSet{node.id, group_id, tag_id, tag});
  }
  std::visit([&](const auto& data) { describe(node.id, data, emit, run_values); }, node.data);
}

void describe_store(const Store& store, const Emit& emit, std::size_t run_values) {
  for (const auto& [id, node] : store.nodes()) describe_node(node, emit, run_values);
}

bool same_content(const Node& a, const Node& b) {
  return a.id == b.id && a.name == b.name && same_parts(a.tag_groups, b.tag_groups) &&
         a.data.index() == b.data.index() &&
         std::visit([&](const auto& data) { return same(data, std::get<std::decay_t<decltype(data)>>(b.data)); },
                    a.data);
}

bool same_content(const Store& a, const Store& b) {
  return std::equal(a.nodes().begin(), a.nodes().end(), b.nodes().begin(), b.nodes().end(),
                    [](const auto& x, const auto& y) { return same_content(x.second, y.second); });
}

}  // namespace septet::scene
