#include "sim-server/drive/edit_rights.hpp"

#include <algorithm>
#include <type_traits>
#include <variant>

#include <fmt/core.h>

#include "engine/replication/message.hpp"
#include "engine/scene/command_validation.hpp"

namespace septet::server {
namespace {

using net::EditKind;

template <class C, class... Kinds>
constexpr bool is_one_of = (std::is_same_v<C, Kinds> || ...);

template <class C>
EditKind kind_of(const C& command) {
  using namespace scene;
  if constexpr (std::is_same_v<C, HideSet>)
    return EditKind::hide;
  else if constexpr (std::is_same_v<C, TransformSet> || std::is_same_v<C, MotionSet>)
    return EditKind::move;
  else if constexpr (std::is_same_v<C, LinkSet>)
    return command.value.label == "material" ? EditKind::paint : EditKind::create;
  else if constexpr (is_one_of<C, FragmentSet, FragmentDestroy, BitmapSizeSet, BitmapLayerSet, BitmapLayerDestroy,
                               BitmapTilesSet, TagGroupSet, TagGroupDestroy, TagSet, TagDestroy>)
    return EditKind::paint;
  return EditKind::create;
}

}  // namespace

bool BatchRights::is_own(scene::NodeId node) const {
  if (created_.contains(node)) return true;
  const auto made = makers_.find(node);
  return made != makers_.end() && made->second == editor_.name;
}

std::optional<std::string> BatchRights::refusal(const scene::NodeCreate& create) {
  if (!editor_.rights.includes(EditKind::create))
    return fmt::format("the key of {} may not create: its line in allowed-clients needs the word create", editor_.name);
  if (returned_ && returned_->contains(create.node)) {
    created_.insert(create.node);
    return std::nullopt;
  }
  if (editor_.own_ids == 0) return "nothing can be created from here: let `septet edit` or a script create it";
  if (create.node < editor_.own_ids || create.node - editor_.own_ids >= replication::ids_per_session)
    return fmt::format("node {} is not one of this editor's ids: use {} to {}", create.node, editor_.own_ids,
                       editor_.own_ids + replication::ids_per_session - 1);
  created_.insert(create.node);
  return std::nullopt;
}

std::optional<std::string> BatchRights::refusal(EditKind kind, scene::NodeId id) const {
  const scene::Node* node = store_.find(id);
  if (!node || is_own(id)) return std::nullopt;
  const auto made = makers_.find(id);
  const bool is_in_reach =
      editor_.rights.names(node->name) || (editor_.rights.prefixes.empty() && made == makers_.end());
  if (is_in_reach && editor_.rights.includes(kind)) return std::nullopt;
  return fmt::format("the key of {} may not {} \"{}\"{}: its line in allowed-clients needs {}", editor_.name,
                     net::name_of(kind), node->name,
                     made == makers_.end() ? "" : fmt::format(", which {} made", made->second),
                     is_in_reach ? fmt::format("the word {}", net::name_of(kind)) : "a prefix of that name");
}

bool BatchRights::is_part_of_generated(scene::NodeId id) const {
  if (makers_.contains(id)) return false;
  return std::ranges::any_of(store_.nodes(), [&](const auto& entry) {
    const auto* object = std::get_if<scene::ObjectData>(&entry.second.data);
    return object && !makers_.contains(entry.first) && std::ranges::any_of(object->links, [&](const auto& link) {
             return link.second.label == "child" && link.second.target == id;
           });
  });
}

/// A child is placed by its parent, so it is moved; and one that is still to come may be somebody else's. A generated thing's
/// part stays where it is, and is seen once more.
std::optional<std::string> BatchRights::refusal_to_hang(scene::NodeId child) const {
  if (editor_.rights.includes(EditKind::create) && is_part_of_generated(child)) return std::nullopt;
  if (store_.find(child) || created_.contains(child)) return refusal(EditKind::move, child);
  return fmt::format("there is no node {} to be a child: create it first", child);
}

std::optional<std::string> BatchRights::refusal(const scene::Command& command) {
  if (const auto* create = std::get_if<scene::NodeCreate>(&command)) return refusal(*create);
  const scene::NodeId node = scene::node_of(command);
  if (node == scene::no_node) return std::nullopt;
  const EditKind kind = std::visit([](const auto& c) { return kind_of(c); }, command);
  if (auto why = refusal(kind, node)) return why;
  if (const auto* link = std::get_if<scene::LinkSet>(&command); link && link->value.label == "child")
    return refusal_to_hang(link->value.target);
  const auto* named = std::get_if<scene::NodeNameSet>(&command);
  if (named && !editor_.rights.prefixes.empty() && !editor_.rights.names(named->name))
    return fmt::format("the key of {} may not call a node \"{}\": its prefixes in allowed-clients have no such name",
                       editor_.name, named->name);
  return std::nullopt;
}

}  // namespace septet::server
