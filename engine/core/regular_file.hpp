#pragma once
/// Reading a whole file that somebody named: a road, a scenario, a rig, a script.

#include <cstddef>
#include <filesystem>
#include <string>

#include "engine/core/expected.hpp"

namespace septet {

/// What a text may be long that is read by a person's word: the largest maps are far shorter.
constexpr std::size_t largest_text_bytes = 512u << 20;

/// The bytes of a regular file (or of what a link leads to). Error, at once and without waiting: there is no such file, it
/// may not be read, it is longer than `largest_bytes`, or it is no file but a folder, a pipe, a socket or a device, whose
/// bytes may never come or never end.
Expected<std::string> read_regular_file(const std::filesystem::path& file,
                                        std::size_t largest_bytes = largest_text_bytes);

}  // namespace septet
