#pragma once
/// Writes a text file, whole or not at all; engine/core/regular_file.hpp reads one.

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::document {

/// Writes beside the target and renames, so that a reader never sees half a file.
Expected<void> write_text_file(const std::filesystem::path& path, std::string_view text);

/// Writes (name, text) each as a file of `folder`, which is created where it does not exist.
Expected<void> write_text_files(const std::filesystem::path& folder,
                                const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace septet::document
