#pragma once
/// Undoing commands: the inverse of each, and batches that are applied whole or not at all.

#include <cstddef>
#include <functional>
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

/// Takes back a batch by the commands that apply_whole returned; nothing may have changed the store since.
void undo(Store& store, std::span<const Command> commands);

/// Tries each command of a batch that is not to be done, and undoes it all: the store's content is what it was.
/// `is_forbidden(index)`: the command is not tried. `failed(index, why)`: the store has refused it; nullptr: it was
/// forbidden. The store is then as the commands before it left it.
void try_each(Store& store, std::span<const Command> batch, const std::function<bool(std::size_t)>& is_forbidden,
              const std::function<void(std::size_t, const Error*)>& failed);

}  // namespace septet::scene
