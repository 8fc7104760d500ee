#include "sim-server/drive/batch_failures.hpp"

#include <algorithm>
#include <variant>

#include <fmt/core.h>

#include "engine/scene/command_validation.hpp"
#include "engine/scene/inverse.hpp"

namespace septet::server {

std::string told_name(const scene::Store& store, scene::NodeId id) {
  if (id == scene::no_node) return {};
  const scene::Node* node = store.find(id);
  return node && !node->name.empty() ? node->name.substr(0, replication::max_failed_name_bytes) : fmt::format("{}", id);
}

void BatchFailures::add(std::size_t index, const scene::Command& command, const std::string& why) {
  const scene::NodeId node = scene::node_of(command);
  const auto was_not_created = [&](scene::NodeId id) {
    const auto found = failed_.find(id);
    return found != failed_.end() && found->second;
  };
  const auto* link = std::get_if<scene::LinkSet>(&command);
  if (was_not_created(node) || (link && was_not_created(link->value.target))) return;
  const bool is_first =
      node == scene::no_node || failed_.try_emplace(node, std::holds_alternative<scene::NodeCreate>(command)).second;
  if (refusal_.failures.size() == replication::most_failures_told) {
    ++refusal_.others;
    return;
  }
  std::string told = is_first ? why : fmt::format("after an earlier failure of this node: {}", why);
  told.resize(std::min(told.size(), replication::max_refusal_bytes));
  refusal_.failures.push_back({index, told_name(store_, node), std::move(told)});
}

replication::Refusal failures_of(scene::Store& store, std::span<const scene::Command> batch,
                                 const std::map<std::size_t, std::string>& forbidden) {
  BatchFailures failures(store);
  scene::try_each(
      store, batch, [&](std::size_t index) { return forbidden.contains(index); },
      [&](std::size_t index, const Error* why) {
        failures.add(index, batch[index], why ? describe(*why) : forbidden.at(index));
      });
  return failures.take();
}

}  // namespace septet::server
