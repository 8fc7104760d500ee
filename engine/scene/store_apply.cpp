/// How each command enters the store. Every function checks everything first and only then changes
/// anything.

#include <algorithm>

#include <fmt/core.h>

#include "engine/core/check.hpp"
#include "engine/scene/command_validation.hpp"
#include "engine/scene/content_weight.hpp"
#include "engine/scene/store.hpp"

namespace septet::scene {
namespace {

/// Ids from here on are kept back, so that the next id never wraps.
constexpr NodeId first_reserved_id = 0xF0000000u;

std::uint64_t layer_values(const GeometryData& geometry, LayerType type) {
  const std::size_t elements =
      is_vertex_layer(type) ? geometry.vertices_m.size() : geometry.polygons.size();
  return std::uint64_t{elements} * layer_width(type);
}

void fit(GeometryLayer& layer, const GeometryData& geometry) {
  const std::size_t values = layer_values(geometry, layer.type);
  if (is_real_layer(layer.type))
    layer.reals.resize(values, layer.default_real);
  else
    layer.integers.resize(values, layer.default_integer);
}

}  // namespace

/// One command's way into the store.
struct Store::Application {
  Store& store;
  const Command& command;

  // ---- common steps

  tl::unexpected<Error> no(std::string what, std::string remedy) const {
    return refuse(command, std::move(what), std::move(remedy));
  }
  Expected<Node*> node(NodeId id) const {
    const auto found = store.nodes_.find(id);
    if (found == store.nodes_.end()) return no("there is no such node", "create the node first");
    return &found->second;
  }
  template <class Data>
  Expected<std::pair<Node*, Data*>> node_with(NodeId id) const {
    auto found = node(id);
    if (!found) return tl::unexpected(found.error());
    Data* data = std::get_if<Data>(&(*found)->data);
    if (!data) return no("the node is of another type", "name a node of the command's type");
    return std::pair{*found, data};
  }
  /// Takes the place of `before` in the account for `after`, or refuses.
  Expected<void> charge(std::uint64_t before, std::uint64_t after) const {
    const std::uint64_t total = store.content_bytes_ - before + after;
    if (after > before && total > store.limits_.bytes)
      return no(fmt::format("the store would hold {} bytes of {}", total, store.limits_.bytes),
                "destroy content or raise StoreLimits::bytes");
    store.content_bytes_ = total;
    return {};
  }
  std::uint64_t touch(Node& changed) const { return changed.revision = ++store.revision_; }

  /// Sets one entry of a map of parts.
  template <class Key, class Part>
  Expected<void> set_part(Node& owner, std::map<Key, Part>& parts, Key id,
                          const Part& value) const {
    const auto found = parts.find(id);
    if (auto ok = charge(found == parts.end() ? 0 : weight(found->second), weight(value)); !ok)
      return ok;
    if (found == parts.end())
      parts.emplace(id, value);
    else
      found->second = value;
    touch(owner);
    return {};
  }
  /// Whether there was anything to destroy.
  template <class Key, class Part>
  bool destroy_part(Node& owner, std::map<Key, Part>& parts, Key id) const {
    const auto found = parts.find(id);
    if (found == parts.end()) return false;
    store.content_bytes_ -= weight(found->second);
    parts.erase(found);
    touch(owner);
    return true;
  }

  // ---- every node

  template <class Subscription>
  requires std::is_same_v<Subscription, NodeIndexSubscribe> ||
      std::is_same_v<Subscription, NodeSubscribe> || std::is_same_v<Subscription, PartSubscribe>
          Expected<void>
  operator()(const Subscription&) const {
    return no("a subscription does not change a store", "hand it to the replication server");
  }
  Expected<void> operator()(const NodeCreate& c) const {
    if (c.node == 0 || c.node >= first_reserved_id)
      return no("the id is out of range", "let the server assign it");
    if (store.nodes_.contains(c.node)) return no("the node exists already", "use a new id");
    if (store.nodes_.size() >= store.limits_.nodes)
      return no(fmt::format("the store holds its {} nodes", store.limits_.nodes),
                "destroy nodes or raise StoreLimits::nodes");
    Node created;
    created.id = c.node;
    switch (c.type) {
      case NodeType::object:
        created.data = ObjectData{};
        break;
      case NodeType::geometry:
        created.data = GeometryData{};
        break;
      case NodeType::material:
        created.data = MaterialData{};
        break;
      case NodeType::bitmap:
        created.data = BitmapData{};
        break;
      default:
        return no("this node type is not kept yet", "use object, geometry, material or bitmap");
    }
    if (auto ok = charge(0, weight(created)); !ok) return ok;
    Node& node = store.nodes_.emplace(c.node, std::move(created)).first->second;
    store.index_revision_ = touch(node);
    store.next_id_ = std::max(store.next_id_, c.node + 1);
    return {};
  }
  Expected<void> operator()(const NodeDestroy& c) const {
    const auto found = store.nodes_.find(c.node);
    if (found == store.nodes_.end()) return {};
    store.content_bytes_ -= weight(found->second);
    store.nodes_.erase(found);
    store.index_revision_ = ++store.revision_;
    return {};
  }
  Expected<void> operator()(const NodeNameSet& c) const {
    const auto named = node(c.node);
    if (!named) return tl::unexpected(named.error());
    if (auto ok = charge((*named)->name.size(), c.name.size()); !ok) return ok;
    (*named)->name = c.name;
    touch(**named);
    return {};
  }
  Expected<void> operator()(const TagGroupSet& c) const {
    const auto owner = node(c.node);
    if (!owner) return tl::unexpected(owner.error());
    auto& groups = (*owner)->tag_groups;
    const auto found = groups.find(c.group);
    const bool exists = found != groups.end();
    if (auto ok = charge(exists ? found->second.name.size() : 0,
                         c.name.size() + (exists ? 0 : container_bytes));
        !ok)
      return ok;
    TagGroup& group = groups[c.group];
    group.name = c.name;
    group.revision = touch(**owner);
    return {};
  }
  Expected<void> operator()(const TagGroupDestroy& c) const {
    const auto owner = node(c.node);
    if (!owner) return tl::unexpected(owner.error());
    destroy_part(**owner, (*owner)->tag_groups, c.group);
    return {};
  }
  Expected<void> operator()(const TagSet& c) const {
    const auto owner = node(c.node);
    if (!owner) return tl::unexpected(owner.error());
    const auto group = (*owner)->tag_groups.find(c.group);
    if (group == (*owner)->tag_groups.end())
      return no("there is no such tag group", "set the group's name first");
    if (auto ok = set_part(**owner, group->second.tags, c.tag, c.value); !ok) return ok;
    group->second.revision = store.revision_;
    return {};
  }
  Expected<void> operator()(const TagDestroy& c) const {
    const auto owner = node(c.node);
    if (!owner) return tl::unexpected(owner.error());
    const auto group = (*owner)->tag_groups.find(c.group);
    if (group == (*owner)->tag_groups.end()) return {};
    if (destroy_part(**owner, group->second.tags, c.tag)) group->second.revision = store.revision_;
    return {};
  }

  // ---- object

  /// Looks the object up and applies `change` to it.
  template <class Change>
  Expected<void> with_object(NodeId id, Change change) const {
    const auto object = node_with<ObjectData>(id);
    if (!object) return tl::unexpected(object.error());
    change(*object->second);
    touch(*object->first);
    return {};
  }
  Expected<void> operator()(const TransformSet& c) const {
    return with_object(c.node, [&](ObjectData& object) { object.transform = c.transform; });
  }
  Expected<void> operator()(const LightSet& c) const {
    return with_object(c.node, [&](ObjectData& object) { object.light = c.light; });
  }
  Expected<void> operator()(const HideSet& c) const {
    return with_object(c.node, [&](ObjectData& object) { object.hidden = c.hidden; });
  }
  Expected<void> operator()(const LinkSet& c) const {
    const auto object = node_with<ObjectData>(c.node);
    if (!object) return tl::unexpected(object.error());
    return set_part(*object->first, object->second->links, c.link, c.value);
  }
  Expected<void> operator()(const LinkDestroy& c) const {
    const auto object = node_with<ObjectData>(c.node);
    if (!object) return tl::unexpected(object.error());
    destroy_part(*object->first, object->second->links, c.link);
    return {};
  }

  // ---- geometry

  Expected<void> operator()(const GeometrySizeSet& c) const {
    const auto found = node_with<GeometryData>(c.node);
    if (!found) return tl::unexpected(found.error());
    if (c.vertices > store.limits_.vertices || c.polygons > store.limits_.polygons)
      return no("the geometry is too large", "divide it among several nodes");
    GeometryData& geometry = *found->second;
    std::uint64_t before = shape_weight(geometry.vertices_m.size(), geometry.polygons.size());
    std::uint64_t after = shape_weight(c.vertices, c.polygons);
    for (const auto& [id, layer] : geometry.layers) {
      before += 4 * layer_values(geometry, layer.type);
      after += std::uint64_t{4} * layer_width(layer.type) *
               (is_vertex_layer(layer.type) ? c.vertices : c.polygons);
    }
    if (auto ok = charge(before, after); !ok) return ok;
    geometry.vertices_m.resize(c.vertices, glm::vec3(0.0f));
    constexpr auto none = geometry::no_vertex;
    geometry.polygons.resize(c.polygons, PolygonCorners{none, none, none, none});
    for (auto& [id, layer] : geometry.layers) fit(layer, geometry);
    geometry.shape_revision = touch(*found->first);
    return {};
  }
  Expected<void> operator()(const GeometryLayerSet& c) const {
    const auto found = node_with<GeometryData>(c.node);
    if (!found) return tl::unexpected(found.error());
    if (c.layer >= base_polygon_layer)
      return no("the id is that of a base layer", "use an id below 65534");
    GeometryData& geometry = *found->second;
    const auto existing = geometry.layers.find(c.layer);
    const bool keeps_values = existing != geometry.layers.end() && existing->second.type == c.type;
    GeometryLayer layer;
    const std::uint64_t after =
        container_bytes + c.name.size() + 4 * layer_values(geometry, c.type);
    if (auto ok = charge(existing == geometry.layers.end() ? 0 : weight(existing->second), after);
        !ok)
      return ok;
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
  Expected<void> operator()(const GeometryLayerDestroy& c) const {
    const auto found = node_with<GeometryData>(c.node);
    if (!found) return tl::unexpected(found.error());
    destroy_part(*found->first, found->second->layers, c.layer);
    return {};
  }
  /// Copies a run into an array that it must lie within; `first` and the run count single values.
  template <class T>
  Expected<void> copy_run(const std::vector<T>& run, std::uint64_t first,
                          std::vector<T>& into) const {
    if (first > into.size() || run.size() > into.size() - first)
      return no(fmt::format("values {} to {} of {}", first, first + run.size(), into.size()),
                "set the size first and stay within it");
    std::copy(run.begin(), run.end(), into.begin() + static_cast<std::ptrdiff_t>(first));
    return {};
  }
  Expected<void> operator()(const VerticesSet& c) const {
    const auto found = node_with<GeometryData>(c.node);
    if (!found) return tl::unexpected(found.error());
    if (auto ok = copy_run(c.positions_m, c.first, found->second->vertices_m); !ok) return ok;
    found->second->shape_revision = touch(*found->first);
    return {};
  }
  Expected<void> operator()(const PolygonsSet& c) const {
    const auto found = node_with<GeometryData>(c.node);
    if (!found) return tl::unexpected(found.error());
    if (auto ok = copy_run(c.polygons, c.first, found->second->polygons); !ok) return ok;
    found->second->shape_revision = touch(*found->first);
    return {};
  }
  template <class Run, class T>
  Expected<void> set_layer_run(const Run& c, std::vector<T> GeometryLayer::*values,
                               bool real) const {
    const auto found = node_with<GeometryData>(c.node);
    if (!found) return tl::unexpected(found.error());
    const auto layer = found->second->layers.find(c.layer);
    if (layer == found->second->layers.end() || is_real_layer(layer->second.type) != real)
      return no("there is no such layer of this kind", "create the layer first");
    const std::uint32_t width = layer_width(layer->second.type);
    if (c.values.size() % width != 0)
      return no("a vertex or polygon is incomplete", "send all values of each");
    if (auto ok = copy_run(c.values, std::uint64_t{c.first} * width, layer->second.*values); !ok)
      return ok;
    layer->second.revision = touch(*found->first);
    return {};
  }
  Expected<void> operator()(const LayerIntegersSet& c) const {
    const Node* owner = store.find(c.node);
    const auto* geometry = owner ? std::get_if<GeometryData>(&owner->data) : nullptr;
    if (geometry && geometry->layers.contains(c.layer) &&
        geometry->layers.at(c.layer).type == LayerType::face_byte &&
        std::any_of(c.values.begin(), c.values.end(),
                    [](std::uint32_t value) { return value > 255; }))
      return no("a face_byte value is over 255", "use a face_integer layer");
    return set_layer_run(c, &GeometryLayer::integers, false);
  }
  Expected<void> operator()(const LayerRealsSet& c) const {
    return set_layer_run(c, &GeometryLayer::reals, true);
  }
  Expected<void> operator()(const CreaseSet& c) const {
    const auto found = node_with<GeometryData>(c.node);
    if (!found) return tl::unexpected(found.error());
    Crease& crease =
        c.kind == CreaseKind::vertex ? found->second->vertex_crease : found->second->edge_crease;
    crease = c.crease;
    touch(*found->first);
    return {};
  }

  // ---- material

  Expected<void> operator()(const FragmentSet& c) const {
    const auto found = node_with<MaterialData>(c.node);
    if (!found) return tl::unexpected(found.error());
    if (c.fragment == no_fragment) return no("the id is out of range", "use an id below 65535");
    return set_part(*found->first, found->second->fragments, c.fragment, c.value);
  }
  Expected<void> operator()(const FragmentDestroy& c) const {
    const auto found = node_with<MaterialData>(c.node);
    if (!found) return tl::unexpected(found.error());
    destroy_part(*found->first, found->second->fragments, c.fragment);
    return {};
  }

  // ---- bitmap

  Expected<void> operator()(const BitmapSizeSet& c) const {
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
  Expected<void> operator()(const BitmapLayerSet& c) const {
    const auto found = node_with<BitmapData>(c.node);
    if (!found) return tl::unexpected(found.error());
    BitmapData& bitmap = *found->second;
    const auto existing = bitmap.layers.find(c.layer);
    const bool keeps_values = existing != bitmap.layers.end() && existing->second.type == c.type;
    const std::uint64_t bytes =
        tile_count(bitmap.width, bitmap.height, bitmap.depth) * tile_bytes(c.type);
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
  Expected<void> operator()(const BitmapLayerDestroy& c) const {
    const auto found = node_with<BitmapData>(c.node);
    if (!found) return tl::unexpected(found.error());
    destroy_part(*found->first, found->second->layers, c.layer);
    return {};
  }
  Expected<void> operator()(const BitmapTilesSet& c) const {
    const auto found = node_with<BitmapData>(c.node);
    if (!found) return tl::unexpected(found.error());
    const auto layer = found->second->layers.find(c.layer);
    if (layer == found->second->layers.end())
      return no("there is no such layer", "create the layer first");
    const std::uint32_t size = tile_bytes(layer->second.type);
    if (c.tiles.size() % size != 0) return no("a tile is incomplete", "send whole tiles");
    if (auto ok = copy_run(c.tiles, std::uint64_t{c.first_tile} * size, layer->second.tiles); !ok)
      return ok;
    layer->second.revision = touch(*found->first);
    return {};
  }
};

Expected<void> Store::apply(const Command& command) {
  if (auto valid = validate(command); !valid) return valid;
  return std::visit(Application{*this, command}, command);
}

NodeId Store::assign_id() {
  SEPTET_CHECK(next_id_ < first_reserved_id, "next id {}", next_id_);
  return next_id_++;
}

}  // namespace septet::scene
