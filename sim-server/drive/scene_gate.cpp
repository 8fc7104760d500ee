#include "sim-server/drive/scene_gate.hpp"

#include <set>
#include <utility>
#include <variant>

#include "engine/scene/inverse.hpp"
#include "sim-server/drive/batch_failures.hpp"
#include "sim-server/drive/edit_rights.hpp"

namespace septet::server {
namespace {

void note_maker(scene::NodeId node, const Editor& editor, const NodeMakers* returned, NodeMakers& makers) {
  const auto before = returned ? returned->find(node) : NodeMakers::const_iterator();
  if (!returned || before == returned->end())
    makers[node] = editor.name;
  else if (!before->second.empty())
    makers[node] = before->second;
}

}  // namespace

std::optional<LeftOfBatch> without_gone(const scene::Store& store, std::span<const scene::Command> batch,
                                        scene::NodeId own_ids) {
  if (own_ids == 0) return std::nullopt;
  std::set<scene::NodeId> created;
  std::vector<std::size_t> left;
  left.reserve(batch.size());
  for (std::size_t i = 0; i < batch.size(); ++i) {
    if (const auto* create = std::get_if<scene::NodeCreate>(&batch[i])) created.insert(create->node);
    const auto* destroy = std::get_if<scene::NodeDestroy>(&batch[i]);
    const bool is_gone = destroy && destroy->node - own_ids < replication::ids_per_session &&
                         !created.contains(destroy->node) && !store.find(destroy->node);
    if (!is_gone) left.push_back(i);
  }
  if (left.size() == batch.size()) return std::nullopt;
  LeftOfBatch rest;
  rest.commands.reserve(left.size());
  for (const std::size_t place : left) rest.commands.push_back(batch[place]);
  rest.places = std::move(left);
  return rest;
}

std::optional<replication::Refusal> pass_gate(scene::Store& store, std::span<const scene::Command> batch,
                                              const Editor& editor, NodeMakers& makers,
                                              const std::function<void(const scene::Command&)>& applied,
                                              const std::function<std::optional<replication::Failure>()>& accept,
                                              const NodeMakers* returned, std::vector<scene::Command>* inverse) {
  BatchRights rights(store, editor, makers, returned);
  std::map<std::size_t, std::string> forbidden;
  for (std::size_t i = 0; i < batch.size(); ++i)
    if (auto why = rights.refusal(batch[i])) forbidden.emplace(i, std::move(*why));
  if (!forbidden.empty()) return failures_of(store, batch, forbidden);
  auto undo = scene::apply_whole(store, batch);
  if (!undo) return failures_of(store, batch, forbidden);
  if (auto refused = accept ? accept() : std::nullopt) {
    scene::undo(store, *undo);
    return replication::Refusal{{std::move(*refused)}, 0};
  }
  for (const scene::Command& command : batch) {
    if (const auto* create = std::get_if<scene::NodeCreate>(&command))
      note_maker(create->node, editor, returned, makers);
    if (const auto* destroy = std::get_if<scene::NodeDestroy>(&command)) makers.erase(destroy->node);
    applied(command);
  }
  if (inverse) *inverse = std::move(*undo);
  return std::nullopt;
}

}  // namespace septet::server
