#pragma once
/// The hash of a store's content: stores of the same content hash alike, however they came to it.

#include <cstdint>

#include "engine/scene/store.hpp"

namespace septet::scene {

/// Of the commands that build the store (describe_store), as COMMANDS.md writes them. Revisions do not count.
std::uint64_t content_hash(const Store& store);

}  // namespace septet::scene
