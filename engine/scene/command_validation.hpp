#pragma once
/// What can be said of a command without its store.

#include "engine/core/expected.hpp"
#include "engine/scene/command.hpp"

namespace septet::scene {

/// Checks that every number is finite, every place, size and speed within its bound (world_bounds.hpp, motion.hpp), every
/// enumeration and index in range, every length within its limit (command_codec.hpp).
Expected<void> validate(const Command& command);

/// The node that a command changes or creates; no_node where it names none.
NodeId node_of(const Command& command);

/// An error about a command: `where` is its name and node.
tl::unexpected<Error> refuse(const Command& command, std::string what, std::string remedy);

}  // namespace septet::scene
