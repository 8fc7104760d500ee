#include "sim-server/temporary_folder.hpp"

#include <cstdlib>
#include <string>
#include <utility>

#include <fmt/core.h>

namespace septet::server {
namespace fs = std::filesystem;

Expected<TemporaryFolder> TemporaryFolder::make(std::string_view name) {
  const char* const remedy = "free space there or set TMPDIR";
  std::error_code error;
  const fs::path parent = fs::temp_directory_path(error);
  if (error) return failure("there is no folder for temporary files: " + error.message(), "TMPDIR", remedy);
  std::string pattern = (parent / fmt::format("{}-XXXXXX", name)).string();
  if (!::mkdtemp(pattern.data())) return failure("cannot make a folder for temporary files", pattern, remedy);
  return TemporaryFolder(pattern);
}

TemporaryFolder::TemporaryFolder(TemporaryFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

}  // namespace septet::server
