#include "engine/scene/inverse.hpp"

#include <algorithm>
#include <iterator>
#include <type_traits>
#include <utility>
#include <variant>

#include "engine/core/check.hpp"

namespace septet::scene {
namespace {

/// The present values of a run as long as `run`; empty where it leaves the array.
template <class T>
std::vector<T> values_before(const std::vector<T>& values, std::uint64_t first, std::size_t count) {
  if (first > values.size() || count > values.size() - first) return {};
  const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

struct Inverse {
  const Store& store;
  std::vector<Command>& undo;

  const Node* node(NodeId id) const { return store.find(id); }
  template <class Data>
  const Data* data(NodeId id) const {
    const Node* found = store.find(id);
    return found ? std::get_if<Data>(&found->data) : nullptr;
  }
  template <class Map>
  static const typename Map::mapped_type* part(const Map& parts, typename Map::key_type id) {
    const auto found = parts.find(id);
    return found == parts.end() ? nullptr : &found->second;
  }
  /// Those commands of the node's description that are chosen.
  template <class Chosen>
  void describe_some(NodeId id, Chosen chosen) const {
    if (const Node* found = node(id))
      describe_node(*found, [&](Command command) {
        if (chosen(command)) undo.push_back(std::move(command));
      });
  }
  /// A layer of this id, with its values.
  void describe_layer(NodeId id, PartId layer) const {
    describe_some(id, [layer](const Command& command) {
      return std::visit(
          [layer](const auto& c) {
            if constexpr (requires { c.layer; })
              if constexpr (std::is_same_v<std::decay_t<decltype(c.layer)>, PartId>) return c.layer == layer;
            return false;
          },
          command);
    });
  }

  template <class Any>
  void operator()(const Any&) const {}  // Subscriptions.

  void operator()(const NodeCreate& c) const {
    if (!node(c.node)) undo.emplace_back(NodeDestroy{c.node});
  }
  void operator()(const NodeDestroy& c) const {
    describe_some(c.node, [](const Command&) { return true; });
  }
  void operator()(const NodeNameSet& c) const {
    if (const Node* named = node(c.node)) undo.emplace_back(NodeNameSet{c.node, named->name});
  }
  void operator()(const TagGroupSet& c) const {
    const Node* owner = node(c.node);
    if (!owner) return;
    if (const TagGroup* group = part(owner->tag_groups, c.group))
      undo.emplace_back(TagGroupSet{c.node, c.group, group->name});
    else
      undo.emplace_back(TagGroupDestroy{c.node, c.group});
  }
  void operator()(const TagGroupDestroy& c) const {
    const Node* owner = node(c.node);
    const TagGroup* group = owner ? part(owner->tag_groups, c.group) : nullptr;
    if (!group) return;
    undo.emplace_back(TagGroupSet{c.node, c.group, group->name});
    for (const auto& [id, tag] : group->tags) undo.emplace_back(TagSet{c.node, c.group, id, tag});
  }
  void restore_tag(NodeId id, PartId group_id, PartId tag_id, bool destroys_new) const {
    const Node* owner = node(id);
    const TagGroup* group = owner ? part(owner->tag_groups, group_id) : nullptr;
    if (!group) return;
    if (const Tag* tag = part(group->tags, tag_id))
      undo.emplace_back(TagSet{id, group_id, tag_id, *tag});
    else if (destroys_new)
      undo.emplace_back(TagDestroy{id, group_id, tag_id});
  }
  void operator()(const TagSet& c) const { restore_tag(c.node, c.group, c.tag, true); }
  void operator()(const TagDestroy& c) const { restore_tag(c.node, c.group, c.tag, false); }

  // ---- objects

  void operator()(const TransformSet& c) const {
    if (const auto* object = data<ObjectData>(c.node)) undo.emplace_back(TransformSet{c.node, object->transform});
  }
  void operator()(const MotionSet& c) const {
    if (const auto* object = data<ObjectData>(c.node)) undo.emplace_back(MotionSet{c.node, object->motion});
  }
  void operator()(const HideSet& c) const {
    if (const auto* object = data<ObjectData>(c.node)) undo.emplace_back(HideSet{c.node, object->hidden});
  }
  void restore_link(NodeId id, PartId link_id, bool destroys_new) const {
    const auto* object = data<ObjectData>(id);
    if (!object) return;
    if (const Link* link = part(object->links, link_id))
      undo.emplace_back(LinkSet{id, link_id, *link});
    else if (destroys_new)
      undo.emplace_back(LinkDestroy{id, link_id});
  }
  void operator()(const LinkSet& c) const { restore_link(c.node, c.link, true); }
  void operator()(const LinkDestroy& c) const { restore_link(c.node, c.link, false); }

  // ---- geometries

  void operator()(const GeometrySizeSet& c) const {
    const auto* geometry = data<GeometryData>(c.node);
    if (!geometry) return;
    const auto vertices = static_cast<std::uint32_t>(geometry->vertices_m.size()),
               polygons = static_cast<std::uint32_t>(geometry->polygons.size());
    undo.emplace_back(GeometrySizeSet{c.node, vertices, polygons});
    if (c.vertices >= vertices && c.polygons >= polygons) return;
    describe_some(c.node, [](const Command& command) {
      return std::holds_alternative<VerticesSet>(command) || std::holds_alternative<PolygonsSet>(command) ||
             std::holds_alternative<LayerIntegersSet>(command) || std::holds_alternative<LayerRealsSet>(command);
    });
  }
  void operator()(const GeometryLayerSet& c) const {
    const auto* geometry = data<GeometryData>(c.node);
    if (!geometry) return;
    const GeometryLayer* layer = part(geometry->layers, c.layer);
    if (!layer)
      undo.emplace_back(GeometryLayerDestroy{c.node, c.layer});
    else if (layer->type != c.type)
      describe_layer(c.node, c.layer);
    else
      undo.emplace_back(
          GeometryLayerSet{c.node, c.layer, layer->name, layer->type, layer->default_integer, layer->default_real});
  }
  void operator()(const GeometryLayerDestroy& c) const { describe_layer(c.node, c.layer); }
  void operator()(const VerticesSet& c) const {
    if (const auto* geometry = data<GeometryData>(c.node))
      undo.emplace_back(
          VerticesSet{c.node, c.first, values_before(geometry->vertices_m, c.first, c.positions_m.size())});
  }
  void operator()(const PolygonsSet& c) const {
    if (const auto* geometry = data<GeometryData>(c.node))
      undo.emplace_back(PolygonsSet{c.node, c.first, values_before(geometry->polygons, c.first, c.polygons.size())});
  }
  template <class Run, class T>
  void restore_run(const Run& c, std::vector<T> GeometryLayer::*values) const {
    const auto* geometry = data<GeometryData>(c.node);
    const GeometryLayer* layer = geometry ? part(geometry->layers, c.layer) : nullptr;
    if (!layer) return;
    const std::uint64_t first = std::uint64_t{c.first} * layer_width(layer->type);
    undo.emplace_back(Run{c.node, c.layer, c.first, values_before(layer->*values, first, c.values.size())});
  }
  void operator()(const LayerIntegersSet& c) const { restore_run(c, &GeometryLayer::integers); }
  void operator()(const LayerRealsSet& c) const { restore_run(c, &GeometryLayer::reals); }
  void operator()(const CreaseSet& c) const {
    if (const auto* geometry = data<GeometryData>(c.node))
      undo.emplace_back(
          CreaseSet{c.node, c.kind, c.kind == CreaseKind::vertex ? geometry->vertex_crease : geometry->edge_crease});
  }

  // ---- materials

  void restore_fragment(NodeId id, FragmentId fragment_id, bool destroys_new) const {
    const auto* material = data<MaterialData>(id);
    if (!material) return;
    if (const Fragment* fragment = part(material->fragments, fragment_id))
      undo.emplace_back(FragmentSet{id, fragment_id, *fragment});
    else if (destroys_new)
      undo.emplace_back(FragmentDestroy{id, fragment_id});
  }
  void operator()(const FragmentSet& c) const { restore_fragment(c.node, c.fragment, true); }
  void operator()(const FragmentDestroy& c) const { restore_fragment(c.node, c.fragment, false); }

  // ---- bitmaps

  void operator()(const BitmapSizeSet& c) const {
    const auto* bitmap = data<BitmapData>(c.node);
    if (!bitmap) return;
    undo.emplace_back(BitmapSizeSet{c.node, bitmap->width, bitmap->height, bitmap->depth});
    describe_some(c.node, [](const Command& command) { return std::holds_alternative<BitmapTilesSet>(command); });
  }
  void operator()(const BitmapLayerSet& c) const {
    const auto* bitmap = data<BitmapData>(c.node);
    if (!bitmap) return;
    const BitmapLayer* layer = part(bitmap->layers, c.layer);
    if (!layer)
      undo.emplace_back(BitmapLayerDestroy{c.node, c.layer});
    else if (layer->type != c.type)
      describe_layer(c.node, c.layer);
    else
      undo.emplace_back(BitmapLayerSet{c.node, c.layer, layer->name, layer->type});
  }
  void operator()(const BitmapLayerDestroy& c) const { describe_layer(c.node, c.layer); }
  void operator()(const BitmapTilesSet& c) const {
    const auto* bitmap = data<BitmapData>(c.node);
    const BitmapLayer* layer = bitmap ? part(bitmap->layers, c.layer) : nullptr;
    if (!layer) return;
    const std::uint64_t first = std::uint64_t{c.first_tile} * tile_bytes(layer->type);
    undo.emplace_back(
        BitmapTilesSet{c.node, c.layer, c.first_tile, values_before(layer->tiles, first, c.tiles.size())});
  }
};

using Inverses = std::vector<std::vector<Command>>;

std::vector<Command> newest_first(Inverses& inverses) {
  std::vector<Command> commands;
  for (auto each = inverses.rbegin(); each != inverses.rend(); ++each)
    std::move(each->begin(), each->end(), std::back_inserter(commands));
  return commands;
}

}  // namespace

std::vector<Command> inverse_of(const Store& store, const Command& command) {
  std::vector<Command> undo;
  std::visit(Inverse{store, undo}, command);
  return undo;
}

void undo(Store& store, std::span<const Command> commands) {
  for (const Command& command : commands) {
    const auto undone = store.apply(command);
    SEPTET_CHECK(undone.has_value(), "a command cannot be undone: {}", undone ? "" : undone.error().what);
  }
}

tl::expected<std::vector<Command>, BatchRefusal> apply_whole(Store& store, std::span<const Command> batch) {
  Inverses inverses;
  for (std::size_t i = 0; i < batch.size(); ++i) {
    std::vector<Command> inverse = inverse_of(store, batch[i]);
    auto done = store.apply(batch[i]);
    if (done) {
      inverses.push_back(std::move(inverse));
      continue;
    }
    undo(store, newest_first(inverses));
    return tl::unexpected(BatchRefusal{i, std::move(done.error())});
  }
  return newest_first(inverses);
}

void try_each(Store& store, std::span<const Command> batch, const std::function<bool(std::size_t)>& is_forbidden,
              const std::function<void(std::size_t, const Error*)>& failed) {
  Inverses inverses;
  for (std::size_t i = 0; i < batch.size(); ++i) {
    if (is_forbidden(i)) {
      failed(i, nullptr);
      continue;
    }
    std::vector<Command> inverse = inverse_of(store, batch[i]);
    if (const auto done = store.apply(batch[i]))
      inverses.push_back(std::move(inverse));
    else
      failed(i, &done.error());
  }
  undo(store, newest_first(inverses));
}

}  // namespace septet::scene
