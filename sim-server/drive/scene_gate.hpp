#pragma once
/// The gate through which the scene of a running drive changes: between two ticks, whole batches or nothing of them.

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/replication/message.hpp"
#include "engine/scene/command.hpp"
#include "engine/scene/store.hpp"
#include "sim-server/host/editor.hpp"

namespace septet::server {

/// The nodes that editors made, with the names of their keys. A node belongs to its maker: others need a right to a
/// prefix of its name.
using NodeMakers = std::map<scene::NodeId, std::string>;

/// What of a batch is still to be done, and where it stood in it.
struct LeftOfBatch {
  std::vector<scene::Command> commands;
  std::vector<std::size_t> places;
};

/// A batch without its commands to destroy nodes of the editor's own ids that are gone already, as those which waited for
/// a tick may be. Empty: there are no such commands.
std::optional<LeftOfBatch> without_gone(const scene::Store& store, std::span<const scene::Command> batch,
                                        scene::NodeId own_ids);

/// Checks a batch of an editor against its rights and applies it to the store, whole or not at all. An id of its own that
/// was used and destroyed may be used again. `accept` sees the store with the batch, and may refuse it still; empty:
/// nothing more is asked. `applied` is called for each command, in order, once all are applied. Of a batch that is
/// refused every command is checked, and each failure answered (batch_failures.hpp). `returned`: nodes that the batch may
/// create again, with their makers (nobody: the world had them). `inverse`: receives the commands that undo it.
std::optional<replication::Refusal> pass_gate(scene::Store& store, std::span<const scene::Command> batch,
                                              const Editor& editor, NodeMakers& makers,
                                              const std::function<void(const scene::Command&)>& applied,
                                              const std::function<std::optional<replication::Failure>()>& accept = {},
                                              const NodeMakers* returned = nullptr,
                                              std::vector<scene::Command>* inverse = nullptr);

}  // namespace septet::server
