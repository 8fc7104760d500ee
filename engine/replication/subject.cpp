#include "engine/replication/subject.hpp"

#include <algorithm>

namespace septet::replication {

using namespace scene;

namespace {

using Kind = SubjectKind;

Change range_change(NodeId node, Kind kind, PartId layer, std::uint32_t first, std::size_t count) {
  return {{node, kind, layer, 0}, first, first + static_cast<std::uint32_t>(count)};
}

template <class Data>
const Data* data_of(const Store& store, NodeId id) {
  const Node* node = store.find(id);
  return node ? std::get_if<Data>(&node->data) : nullptr;
}

template <class Parts>
auto find_part(const Parts& parts, typename Parts::key_type id) -> const typename Parts::mapped_type* {
  const auto found = parts.find(id);
  return found == parts.end() ? nullptr : &found->second;
}

/// Values of one element of a layer, or 1 where the layer does not exist.
std::uint32_t width_of(const Store& store, NodeId node, PartId layer) {
  const auto* geometry = data_of<GeometryData>(store, node);
  const auto* found = geometry ? find_part(geometry->layers, layer) : nullptr;
  return found ? layer_width(found->type) : 1;
}
std::uint32_t tile_size_of(const Store& store, NodeId node, PartId layer) {
  const auto* bitmap = data_of<BitmapData>(store, node);
  const auto* found = bitmap ? find_part(bitmap->layers, layer) : nullptr;
  return found ? tile_bytes(found->type) : 1;
}

struct ChangeOf {
  const Store& store;
  using Result = std::optional<Change>;

  static Result whole(NodeId node, Kind kind, PartId part = 0, PartId item = 0) {
    return Change{{node, kind, part, item}};
  }
  static Result renewed(NodeId node, Kind kind, PartId part) {
    Change change{{node, kind, part, 0}};
    change.renew = true;
    return change;
  }
  Result operator()(const NodeIndexSubscribe&) const { return {}; }
  Result operator()(const NodeSubscribe&) const { return {}; }
  Result operator()(const PartSubscribe&) const { return {}; }
  Result operator()(const NodeCreate& c) const { return whole(c.node, Kind::existence); }
  Result operator()(const NodeDestroy& c) const { return renewed(c.node, Kind::existence, 0); }
  Result operator()(const NodeNameSet& c) const { return whole(c.node, Kind::name); }
  Result operator()(const TagGroupSet& c) const { return whole(c.node, Kind::tag_group, c.group); }
  Result operator()(const TagGroupDestroy& c) const { return renewed(c.node, Kind::tag_group, c.group); }
  Result operator()(const TagSet& c) const { return whole(c.node, Kind::tag, c.group, c.tag); }
  Result operator()(const TagDestroy& c) const { return whole(c.node, Kind::tag, c.group, c.tag); }
  Result operator()(const TransformSet& c) const { return whole(c.node, Kind::transform); }
  Result operator()(const MotionSet& c) const { return whole(c.node, Kind::motion); }
  Result operator()(const LinkSet& c) const { return whole(c.node, Kind::link, c.link); }
  Result operator()(const LinkDestroy& c) const { return whole(c.node, Kind::link, c.link); }
  Result operator()(const HideSet& c) const { return whole(c.node, Kind::hide); }
  Result operator()(const GeometrySizeSet& c) const {
    Change change{{c.node, Kind::geometry_size, 0, 0}};
    change.smallest_vertices = c.vertices;
    change.smallest_polygons = c.polygons;
    return change;
  }
  Result operator()(const GeometryLayerSet& c) const { return whole(c.node, Kind::geometry_layer, c.layer); }
  Result operator()(const GeometryLayerDestroy& c) const { return renewed(c.node, Kind::geometry_layer, c.layer); }
  Result operator()(const VerticesSet& c) const {
    return range_change(c.node, Kind::vertices, base_vertex_layer, c.first, c.positions_m.size());
  }
  Result operator()(const PolygonsSet& c) const {
    return range_change(c.node, Kind::polygons, base_polygon_layer, c.first, c.polygons.size());
  }
  Result operator()(const LayerIntegersSet& c) const {
    return range_change(c.node, Kind::layer_values, c.layer, c.first,
                        c.values.size() / width_of(store, c.node, c.layer));
  }
  Result operator()(const LayerRealsSet& c) const {
    return range_change(c.node, Kind::layer_values, c.layer, c.first,
                        c.values.size() / width_of(store, c.node, c.layer));
  }
  Result operator()(const CreaseSet& c) const { return whole(c.node, Kind::crease, static_cast<PartId>(c.kind)); }
  Result operator()(const FragmentSet& c) const { return whole(c.node, Kind::fragment, c.fragment); }
  Result operator()(const FragmentDestroy& c) const { return whole(c.node, Kind::fragment, c.fragment); }
  Result operator()(const BitmapSizeSet& c) const { return whole(c.node, Kind::bitmap_size); }
  Result operator()(const BitmapLayerSet& c) const { return whole(c.node, Kind::bitmap_layer, c.layer); }
  Result operator()(const BitmapLayerDestroy& c) const { return renewed(c.node, Kind::bitmap_layer, c.layer); }
  Result operator()(const BitmapTilesSet& c) const {
    return range_change(c.node, Kind::tiles, c.layer, c.first_tile,
                        c.tiles.size() / tile_size_of(store, c.node, c.layer));
  }
};

/// The type of node that has such subjects; empty where every type has them.
std::optional<NodeType> type_of(Kind kind) {
  switch (kind) {
    case Kind::existence:
    case Kind::name:
    case Kind::tag_group:
    case Kind::tag:
      return {};
    case Kind::transform:
    case Kind::motion:
    case Kind::link:
    case Kind::hide:
      return NodeType::object;
    case Kind::geometry_size:
    case Kind::crease:
    case Kind::geometry_layer:
    case Kind::vertices:
    case Kind::polygons:
    case Kind::layer_values:
      return NodeType::geometry;
    case Kind::fragment:
      return NodeType::material;
    case Kind::bitmap_size:
    case Kind::bitmap_layer:
    case Kind::tiles:
      return NodeType::bitmap;
  }
  return {};
}

template <class T>
std::vector<T> slice(const std::vector<T>& values, const Change& c, std::size_t width) {
  const auto begin = values.begin() + static_cast<std::ptrdiff_t>(c.first * width);
  return {begin, begin + static_cast<std::ptrdiff_t>((c.end - c.first) * width)};
}

}  // namespace

std::optional<Change> change_of(const Command& command, const Store& store) {
  return std::visit(ChangeOf{store}, command);
}

std::uint32_t element_count(const Store& store, const Subject& subject) {
  std::size_t count = 0;
  if (const auto* geometry = data_of<GeometryData>(store, subject.node)) {
    if (subject.kind == Kind::vertices) count = geometry->vertices_m.size();
    if (subject.kind == Kind::polygons) count = geometry->polygons.size();
    if (subject.kind == Kind::layer_values)
      if (const auto* layer = find_part(geometry->layers, subject.part))
        count = (layer->integers.size() + layer->reals.size()) / layer_width(layer->type);
  }
  if (const auto* bitmap = data_of<BitmapData>(store, subject.node); bitmap && subject.kind == Kind::tiles)
    if (const auto* layer = find_part(bitmap->layers, subject.part))
      count = layer->tiles.size() / tile_bytes(layer->type);
  return static_cast<std::uint32_t>(count);
}

std::uint32_t elements_in(const Store& store, const Subject& subject, std::size_t bytes) {
  std::size_t one = 1;
  switch (subject.kind) {
    case Kind::vertices:
      one = 12;
      break;
    case Kind::polygons:
      one = 16;
      break;
    case Kind::layer_values:
      one = 4 * width_of(store, subject.node, subject.part);
      break;
    case Kind::tiles:
      one = tile_size_of(store, subject.node, subject.part);
      break;
    default:
      break;
  }
  return static_cast<std::uint32_t>(std::max<std::size_t>(1, bytes / one));
}

void describe_change(const Store& store, const Change& change, const std::function<void(const Command&)>& emit) {
  const auto [id, kind, part, item] = change.subject;
  const Node* node = store.find(id);
  if (kind == Kind::existence) {
    if (!node || change.renew) emit(NodeDestroy{id});
    if (node) emit(NodeCreate{id, node->type()});
    return;
  }
  if (!node) return;
  const auto* object = std::get_if<ObjectData>(&node->data);
  const auto* geometry = std::get_if<GeometryData>(&node->data);
  const auto* material = std::get_if<MaterialData>(&node->data);
  const auto* bitmap = std::get_if<BitmapData>(&node->data);
  // A change that waited for a resumed client may be of a node whose id has been given to another type since.
  if (const auto type = type_of(kind); type && *type != node->type()) return;
  Change cut = change;
  if (is_range(kind)) {
    cut.end = std::min(cut.end, element_count(store, change.subject));
    if (cut.first >= cut.end) return;
  }
  switch (kind) {
    case Kind::existence:
      return;
    case Kind::name:
      return emit(NodeNameSet{id, node->name});
    case Kind::tag_group: {
      if (change.renew) emit(TagGroupDestroy{id, part});
      if (const auto* group = find_part(node->tag_groups, part)) emit(TagGroupSet{id, part, group->name});
      return;
    }
    case Kind::tag: {
      const auto* group = find_part(node->tag_groups, part);
      if (!group) return;
      if (const auto* tag = find_part(group->tags, item))
        emit(TagSet{id, part, item, *tag});
      else
        emit(TagDestroy{id, part, item});
      return;
    }
    case Kind::transform:
      return emit(TransformSet{id, object->transform});
    case Kind::motion:
      return emit(MotionSet{id, object->motion});
    case Kind::link: {
      if (const auto* link = find_part(object->links, part))
        emit(LinkSet{id, part, *link});
      else
        emit(LinkDestroy{id, part});
      return;
    }
    case Kind::hide:
      return emit(HideSet{id, object->hidden});
    case Kind::geometry_size: {
      const auto vertices = static_cast<std::uint32_t>(geometry->vertices_m.size());
      const auto polygons = static_cast<std::uint32_t>(geometry->polygons.size());
      if (change.smallest_vertices < vertices || change.smallest_polygons < polygons)
        emit(GeometrySizeSet{id, std::min(vertices, change.smallest_vertices),
                             std::min(polygons, change.smallest_polygons)});
      return emit(GeometrySizeSet{id, vertices, polygons});
    }
    case Kind::crease: {
      const auto which = static_cast<CreaseKind>(part);
      return emit(CreaseSet{id, which, which == CreaseKind::vertex ? geometry->vertex_crease : geometry->edge_crease});
    }
    case Kind::geometry_layer: {
      if (change.renew) emit(GeometryLayerDestroy{id, part});
      if (const auto* layer = find_part(geometry->layers, part))
        emit(GeometryLayerSet{id, part, layer->name, layer->type, layer->default_integer, layer->default_real});
      return;
    }
    case Kind::vertices:
      return emit(VerticesSet{id, cut.first, slice(geometry->vertices_m, cut, 1)});
    case Kind::polygons:
      return emit(PolygonsSet{id, cut.first, slice(geometry->polygons, cut, 1)});
    case Kind::layer_values: {
      const GeometryLayer& layer = geometry->layers.at(part);
      const std::size_t width = layer_width(layer.type);
      if (is_real_layer(layer.type))
        emit(LayerRealsSet{id, part, cut.first, slice(layer.reals, cut, width)});
      else
        emit(LayerIntegersSet{id, part, cut.first, slice(layer.integers, cut, width)});
      return;
    }
    case Kind::fragment: {
      if (const auto* fragment = find_part(material->fragments, part))
        emit(FragmentSet{id, part, *fragment});
      else
        emit(FragmentDestroy{id, part});
      return;
    }
    case Kind::bitmap_size:
      return emit(BitmapSizeSet{id, bitmap->width, bitmap->height, bitmap->depth});
    case Kind::bitmap_layer: {
      if (change.renew) emit(BitmapLayerDestroy{id, part});
      if (const auto* layer = find_part(bitmap->layers, part)) emit(BitmapLayerSet{id, part, layer->name, layer->type});
      return;
    }
    case Kind::tiles: {
      const BitmapLayer& layer = bitmap->layers.at(part);
      return emit(BitmapTilesSet{id, part, cut.first, slice(layer.tiles, cut, tile_bytes(layer.type))});
    }
  }
}

void mark_node(const Node& node, const Mark& mark) {
  const auto whole = [&](Kind kind, PartId part = 0) { mark({{node.id, kind, part, 0}}); };
  if (!node.name.empty()) whole(Kind::name);
  for (const auto& [id, group] : node.tag_groups) whole(Kind::tag_group, id);
  if (const auto* object = std::get_if<ObjectData>(&node.data)) {
    whole(Kind::transform);
    if (object->motion != Motion{}) whole(Kind::motion);
    for (const auto& [id, link] : object->links) whole(Kind::link, id);
    if (object->hidden) whole(Kind::hide);
  }
  if (const auto* geometry = std::get_if<GeometryData>(&node.data)) {
    whole(Kind::geometry_size);
    for (const CreaseKind kind : {CreaseKind::vertex, CreaseKind::edge}) whole(Kind::crease, static_cast<PartId>(kind));
    for (const auto& [id, layer] : geometry->layers) whole(Kind::geometry_layer, id);
  }
  if (const auto* material = std::get_if<MaterialData>(&node.data))
    for (const auto& [id, fragment] : material->fragments) whole(Kind::fragment, id);
  if (const auto* bitmap = std::get_if<BitmapData>(&node.data)) {
    whole(Kind::bitmap_size);
    for (const auto& [id, layer] : bitmap->layers) whole(Kind::bitmap_layer, id);
  }
}

void mark_part(const Store& store, NodeId id, PartKind kind, PartId part, const Mark& mark) {
  const Node* node = store.find(id);
  if (!node) return;
  if (kind == PartKind::tag_group) {
    if (const auto* group = find_part(node->tag_groups, part))
      for (const auto& [tag, value] : group->tags) mark({{id, Kind::tag, part, tag}});
    return;
  }
  Subject subject{id, Kind::layer_values, part, 0};
  if (node->type() == NodeType::bitmap) subject.kind = Kind::tiles;
  if (node->type() == NodeType::geometry && part == base_vertex_layer) subject.kind = Kind::vertices;
  if (node->type() == NodeType::geometry && part == base_polygon_layer) subject.kind = Kind::polygons;
  if (const std::uint32_t count = element_count(store, subject)) mark({subject, 0, count});
}

}  // namespace septet::replication
