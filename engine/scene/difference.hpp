#pragma once
/// What differs between two stores, as commands: what is saved of a world that was edited.

#include <functional>

#include "engine/scene/command.hpp"
#include "engine/scene/store.hpp"

namespace septet::scene {

/// The commands that turn the content of `before` into that of `after`; names of nodes of `before` are changed last, so
/// that they are known by their old ones until then.
void describe_difference(const Store& before, const Store& after, const std::function<void(Command)>& emit);

}  // namespace septet::scene
