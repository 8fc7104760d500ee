#include "engine/scene/difference.hpp"

#include <algorithm>
#include <variant>
#include <vector>

namespace septet::scene {
namespace {

using Emit = std::function<void(Command)>;

std::vector<Command> described(const Node& node) {
  std::vector<Command> commands;
  describe_node(node, [&](Command command) { commands.push_back(std::move(command)); });
  return commands;
}

template <class... Kinds>
bool is_one_of(const Command& command) {
  return (std::holds_alternative<Kinds>(command) || ...);
}

/// Commands that `describe_node` leaves out where the value is the usual one.
std::vector<Command> usual_values(const Node& node) {
  if (const auto* object = std::get_if<ObjectData>(&node.data))
    return {TransformSet{node.id, object->transform}, MotionSet{node.id, object->motion},
            HideSet{node.id, object->hidden}};
  if (const auto* geometry = std::get_if<GeometryData>(&node.data))
    return {GeometrySizeSet{node.id, static_cast<std::uint32_t>(geometry->vertices_m.size()),
                            static_cast<std::uint32_t>(geometry->polygons.size())},
            CreaseSet{node.id, CreaseKind::vertex, geometry->vertex_crease},
            CreaseSet{node.id, CreaseKind::edge, geometry->edge_crease}};
  if (const auto* bitmap = std::get_if<BitmapData>(&node.data))
    return {BitmapSizeSet{node.id, bitmap->width, bitmap->height, bitmap->depth}};
  return {};
}

template <class Destroy, class Parts>
void destroy_absent(NodeId node, const Parts& before, const Parts& after, const Emit& emit) {
  for (const auto& [id, part] : before)
    if (!after.contains(id)) emit(Destroy{node, id});
}

/// Parts that are no longer there.
void describe_absent(const Node& before, const Node& after, const Emit& emit) {
  const NodeId id = after.id;
  destroy_absent<TagGroupDestroy>(id, before.tag_groups, after.tag_groups, emit);
  for (const auto& [group_id, group] : before.tag_groups) {
    const auto now = after.tag_groups.find(group_id);
    if (now == after.tag_groups.end()) continue;
    for (const auto& [tag_id, tag] : group.tags)
      if (!now->second.tags.contains(tag_id)) emit(TagDestroy{id, group_id, tag_id});
  }
  if (const auto* object = std::get_if<ObjectData>(&before.data))
    destroy_absent<LinkDestroy>(id, object->links, std::get<ObjectData>(after.data).links, emit);
  if (const auto* geometry = std::get_if<GeometryData>(&before.data))
    destroy_absent<GeometryLayerDestroy>(id, geometry->layers, std::get<GeometryData>(after.data).layers, emit);
  if (const auto* material = std::get_if<MaterialData>(&before.data))
    destroy_absent<FragmentDestroy>(id, material->fragments, std::get<MaterialData>(after.data).fragments, emit);
  if (const auto* bitmap = std::get_if<BitmapData>(&before.data))
    destroy_absent<BitmapLayerDestroy>(id, bitmap->layers, std::get<BitmapData>(after.data).layers, emit);
}

void describe_changed(const Node& before, const Node& after, const Emit& emit) {
  describe_absent(before, after, emit);
  std::vector<Command> old = described(before), now = usual_values(after);
  const auto old_values = usual_values(before);
  old.insert(old.end(), old_values.begin(), old_values.end());
  for (Command& command : described(after))
    if (std::ranges::find(now, command) == now.end()) now.push_back(std::move(command));
  const auto is_new = [&](const Command& command) { return std::ranges::find(old, command) == old.end(); };
  const auto is_frame = [](const Command& command) {
    return is_one_of<GeometrySizeSet, GeometryLayerSet, BitmapSizeSet, BitmapLayerSet>(command);
  };
  // A changed size or layer clears values.
  const bool anew =
      std::ranges::any_of(now, [&](const Command& command) { return is_frame(command) && is_new(command); });
  for (Command& command : now) {
    const bool is_run = is_one_of<VerticesSet, PolygonsSet, LayerIntegersSet, LayerRealsSet, BitmapTilesSet>(command);
    if (!is_one_of<NodeNameSet>(command) && (is_new(command) || (anew && is_run))) emit(std::move(command));
  }
}

}  // namespace

void describe_difference(const Store& before, const Store& after, const Emit& emit) {
  const auto is_kept = [](const Node& node, const Store& in) {
    const Node* other = in.find(node.id);
    return other && other->type() == node.type() ? other : nullptr;
  };
  for (const auto& [id, node] : before.nodes())
    if (!is_kept(node, after)) emit(NodeDestroy{id});
  for (const auto& [id, node] : after.nodes()) {
    const Node* old = is_kept(node, before);
    if (!old)
      describe_node(node, emit);
    else if (!same_content(*old, node))
      describe_changed(*old, node, emit);
  }
  for (const auto& [id, node] : after.nodes())
    if (const Node* old = is_kept(node, before); old && old->name != node.name) emit(NodeNameSet{id, node.name});
}

}  // namespace septet::scene
