#pragma once
/// Files of edits: lines of commands (command_text.hpp) over a generated world, whose nodes they mean by name.

#include <string>
#include <string_view>

#include "engine/core/expected.hpp"
#include "engine/scene/store.hpp"

namespace septet::scene {

/// The ids that a file's +0, +1 … stand for where the world's owner applies it. No session has them.
inline constexpr NodeId edit_file_ids = 0x40000000u;

/// Applies the lines one after another. Error, printable: which line cannot be done, and why; those before it are done.
Expected<void> apply_edits(Store& store, std::string_view text, std::string_view where);

/// The lines that turn a world like `before` into `after`: nodes that it has not are +0, +1 …
std::string edits_between(const Store& before, const Store& after);

}  // namespace septet::scene
