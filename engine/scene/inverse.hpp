#pragma once
/// Undoing commands: the inverse of each, and batches that are applied whole or not at all.

#include <cstddef>
#include <span>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/scene/command.hpp"
#include "engine/scene/store.hpp"

namespace septet::scene {

/// The commands that, applied in order after `command`, give the store its present content again; none for a
/// subscription, and for a command that the store will refuse.
std::vector<Command> inverse_of(const Store& store, const Command& command);

/// The first refused command of a batch.
struct BatchRefusal {
  std::size_t index = 0;
  Error why;
};

/// Applies all commands, or none: after a refusal the store's content is what it was. Returns the commands that undo the
/// batch.
tl::expected<std::vector<Command>, BatchRefusal> apply_whole(Store& store, std::span<const Command> batch);

}  // namespace septet::scene
