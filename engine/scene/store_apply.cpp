/// Commands of every node and of objects.

#include "engine/core/check.hpp"
#include "engine/scene/store_application.hpp"

namespace septet::scene {
namespace {

/// Ids from here on are reserved, so that the next id never wraps.
constexpr NodeId first_reserved_id = 0xF0000000u;

}  // namespace

Expected<void> Store::Application::operator()(const NodeCreate& c) const {
  if (c.node == 0 || c.node >= first_reserved_id) return no("the id is out of range", "let the server assign it");
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
  }
  if (auto ok = charge(0, weight(created)); !ok) return ok;
  Node& node = store.nodes_.emplace(c.node, std::move(created)).first->second;
  store.index_revision_ = touch(node);
  store.next_id_ = std::max(store.next_id_, c.node + 1);
  return {};
}

Expected<void> Store::Application::operator()(const NodeDestroy& c) const {
  const auto found = store.nodes_.find(c.node);
  if (found == store.nodes_.end()) return {};
  store.content_bytes_ -= weight(found->second);
  store.nodes_.erase(found);
  store.index_revision_ = ++store.revision_;
  store.changes_.add(store.revision_, {c.node, 0, 0, 0});
  return {};
}

Expected<void> Store::Application::operator()(const NodeNameSet& c) const {
  const auto named = node(c.node);
  if (!named) return tl::unexpected(named.error());
  if (auto ok = charge((*named)->name.size(), c.name.size()); !ok) return ok;
  const bool drawn = (*named)->name.starts_with(prototype_prefix) || c.name.starts_with(prototype_prefix);
  (*named)->name = c.name;
  touch(**named, drawn);
  return {};
}

Expected<void> Store::Application::operator()(const TagGroupSet& c) const {
  const auto owner = node(c.node);
  if (!owner) return tl::unexpected(owner.error());
  auto& groups = (*owner)->tag_groups;
  const auto found = groups.find(c.group);
  const bool exists = found != groups.end();
  if (auto ok = charge(exists ? found->second.name.size() : 0, c.name.size() + (exists ? 0 : container_bytes)); !ok)
    return ok;
  TagGroup& group = groups[c.group];
  const bool drawn = is_drawn_tag_group(group.name) || is_drawn_tag_group(c.name);
  group.name = c.name;
  group.revision = touch(**owner, drawn);
  return {};
}

Expected<void> Store::Application::operator()(const TagGroupDestroy& c) const {
  const auto owner = node(c.node);
  if (!owner) return tl::unexpected(owner.error());
  const auto group = (*owner)->tag_groups.find(c.group);
  if (group == (*owner)->tag_groups.end()) return {};
  const bool drawn = is_drawn_tag_group(group->second.name);
  destroy_part(**owner, (*owner)->tag_groups, c.group, drawn);
  return {};
}

Expected<void> Store::Application::operator()(const TagSet& c) const {
  const auto owner = node(c.node);
  if (!owner) return tl::unexpected(owner.error());
  const auto group = (*owner)->tag_groups.find(c.group);
  if (group == (*owner)->tag_groups.end()) return no("there is no such tag group", "set the group's name first");
  const bool drawn = is_drawn_tag_group(group->second.name);
  if (auto ok = set_part(**owner, group->second.tags, c.tag, c.value, drawn); !ok) return ok;
  group->second.revision = store.revision_;
  return {};
}

Expected<void> Store::Application::operator()(const TagDestroy& c) const {
  const auto owner = node(c.node);
  if (!owner) return tl::unexpected(owner.error());
  const auto group = (*owner)->tag_groups.find(c.group);
  if (group == (*owner)->tag_groups.end()) return {};
  const bool drawn = is_drawn_tag_group(group->second.name);
  if (destroy_part(**owner, group->second.tags, c.tag, drawn)) group->second.revision = store.revision_;
  return {};
}

Expected<void> Store::Application::operator()(const TransformSet& c) const {
  return with_object(c.node, [&](ObjectData& object) { object.transform = c.transform; });
}

Expected<void> Store::Application::operator()(const HideSet& c) const {
  return with_object(c.node, [&](ObjectData& object) { object.hidden = c.hidden; });
}

Expected<void> Store::Application::operator()(const MotionSet& c) const {
  if (c.from_now) return no("the motion's times are not known yet", "ask the server of a drive");
  const auto object = node_with<ObjectData>(c.node);
  if (!object) return tl::unexpected(object.error());
  if (auto ok = charge(weight(object->second->motion), weight(c.motion)); !ok) return ok;
  object->second->motion = c.motion;
  touch(*object->first);
  return {};
}

Expected<void> Store::Application::operator()(const LinkSet& c) const {
  const auto object = node_with<ObjectData>(c.node);
  if (!object) return tl::unexpected(object.error());
  return set_part(*object->first, object->second->links, c.link, c.value);
}

Expected<void> Store::Application::operator()(const LinkDestroy& c) const {
  const auto object = node_with<ObjectData>(c.node);
  if (!object) return tl::unexpected(object.error());
  destroy_part(*object->first, object->second->links, c.link);
  return {};
}

Expected<void> Store::apply(const Command& command) {
  if (auto valid = validate(command); !valid) return valid;
  return std::visit(Application{*this, command}, command);
}

NodeId Store::assign_id() {
  SEPTET_CHECK(next_id_ < first_reserved_id, "next id {}", next_id_);
  return next_id_++;
}

}  // namespace septet::scene
