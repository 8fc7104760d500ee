#pragma once
/// Which commands of a refused batch could not be done, gathered in their order, for the answer to their editor.

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "engine/replication/message.hpp"
#include "engine/scene/command.hpp"
#include "engine/scene/store.hpp"

namespace septet::server {

/// The name of a failed command's node, as it is told: its number where it has no name, nothing of no_node.
std::string told_name(const scene::Store& store, scene::NodeId id);

/// Keeps as many failures as are told and counts the others. A command whose node an earlier one should have created
/// fails for that reason alone: it is left out. One that fails after another of the same node is told so.
class BatchFailures {
 public:
  /// The store outlives it, and names the nodes as the commands before have left them.
  explicit BatchFailures(const scene::Store& store) : store_(store) {}

  void add(std::size_t index, const scene::Command& command, const std::string& why);
  replication::Refusal take() { return std::move(refusal_); }

 private:
  const scene::Store& store_;
  replication::Refusal refusal_;
  std::map<scene::NodeId, bool> failed_;  ///< By node: true where it is its creation that failed first.
};

/// Why nothing of a batch may be done: its commands that are forbidden, and those that the store refuses. The store's
/// content is what it was.
replication::Refusal failures_of(scene::Store& store, std::span<const scene::Command> batch,
                                 const std::map<std::size_t, std::string>& forbidden);

}  // namespace septet::server
