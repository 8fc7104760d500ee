#pragma once
/// A text becomes a file, whole or not at all.

#include <filesystem>
#include <string_view>

#include "engine/core/expected.hpp"

namespace septet::logging {

/// Writes beside the target and renames, so that a reader never meets half a file.
Expected<void> write_text_file(const std::filesystem::path& path, std::string_view text);

}  // namespace septet::logging
