#pragma once
/// Reads a whole file named by a user: a road, a scenario, a rig, a script.

#include <cstddef>
#include <filesystem>
#include <string>

#include "engine/core/expected.hpp"

namespace septet {

/// Bound on a text file named by a user: the largest maps are far shorter.
constexpr std::size_t largest_text_bytes = 512u << 20;

/// The bytes of a regular file (or of a link's target). Error, at once and without waiting: it does not exist, cannot
/// be read, is longer than `largest_bytes`, or is a folder, a pipe, a socket or a device, whose bytes may never come or
/// never end.
Expected<std::string> read_regular_file(const std::filesystem::path& file,
                                        std::size_t largest_bytes = largest_text_bytes);

}  // namespace septet
