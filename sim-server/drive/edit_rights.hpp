#pragma once
/// Whether an editor may do what a batch asks for, by its rights, who made a node, and the node's name.

#include <optional>
#include <set>
#include <string>

#include "engine/scene/command.hpp"
#include "engine/scene/store.hpp"
#include "sim-server/drive/scene_gate.hpp"

namespace septet::server {

/// Reads the commands of one batch in their order, before any is applied.
class BatchRights {
 public:
  /// All arguments outlive it. `returned`: nodes that may be created again; null: none.
  BatchRights(const scene::Store& store, const Editor& editor, const NodeMakers& makers, const NodeMakers* returned)
      : store_(store), editor_(editor), makers_(makers), returned_(returned) {}

  /// The reason why the next command may not be done. A node that is not there is the store's to refuse.
  std::optional<std::string> refusal(const scene::Command& command);

 private:
  std::optional<std::string> refusal(const scene::NodeCreate& create);
  std::optional<std::string> refusal(net::EditKind kind, scene::NodeId node) const;
  std::optional<std::string> refusal_to_hang(scene::NodeId child) const;
  bool is_own(scene::NodeId node) const;
  /// True for a child of a thing that the world was generated with.
  bool is_part_of_generated(scene::NodeId node) const;

  const scene::Store& store_;
  const Editor& editor_;
  const NodeMakers& makers_;
  const NodeMakers* returned_;
  std::set<scene::NodeId> created_;  ///< By earlier commands of the batch.
};

}  // namespace septet::server
