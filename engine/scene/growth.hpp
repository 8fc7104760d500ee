#pragma once
/// What a batch's sizes make of nothing: elements of geometries and their layers that no value of the batch need set. A command
/// of twenty bytes makes a hundred megabytes so, and holds up whoever applies it.

#include <cstdint>
#include <span>

#include "engine/scene/command.hpp"
#include "engine/scene/store.hpp"

namespace septet::scene {

/// Bytes by which the batch's sizes and layers let geometries grow, in their order, what shrinks between left out. Pure.
std::uint64_t grown_bytes(const Store& store, std::span<const Command> batch);

}  // namespace septet::scene
