#pragma once
/// The gate through which the scene of a running drive changes: between two ticks, whole batches or nothing of them.

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "engine/scene/command.hpp"
#include "engine/scene/store.hpp"

namespace septet::server {

/// Why nothing of a batch was done.
struct EditRefusal {
  std::size_t index = 0;  ///< Of the command that could not be done.
  std::string why;        ///< What is wrong, where, and what to do.
};

/// Checks a batch of an editor and applies it to the store, whole or not at all. New nodes need ids from `own_ids` on,
/// ids_per_session of them; one that was used and destroyed may be used again. `applied` is called for each command, in
/// order, once all are applied.
std::optional<EditRefusal> pass_gate(scene::Store& store, std::span<const scene::Command> batch, scene::NodeId own_ids,
                                     const std::function<void(const scene::Command&)>& applied);

}  // namespace septet::server
