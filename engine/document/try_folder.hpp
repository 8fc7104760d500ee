#pragma once
/// Long work is not lost to a folder that cannot be written.

#include <filesystem>

#include "engine/core/expected.hpp"

namespace septet::document {

/// Tries whether a folder can be made and written, and leaves nothing of it. Error: it cannot; why, and the folder.
Expected<void> try_folder(const std::filesystem::path& folder);

}  // namespace septet::document
