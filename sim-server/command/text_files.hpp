#pragma once
/// What a command writes beside what it prints.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::server {

/// (name, text) each as a file of `folder`, which is made where it is not there.
Expected<void> write_text_files(const std::filesystem::path& folder,
                                const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace septet::server
