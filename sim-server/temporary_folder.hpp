#pragma once
/// A folder for files that only one run needs: made empty, readable by this user alone, and gone with all that is in it.
///
/// A run that is killed leaves its folder behind, and the next one removes it: a living run holds a lock (flock) on its own.

#include <filesystem>
#include <string_view>

#include "engine/core/expected.hpp"

namespace septet::server {

class TemporaryFolder {
 public:
  /// Below TMPDIR, named `name`, a hyphen and six random letters. Error: no folder can be made there.
  static Expected<TemporaryFolder> make(std::string_view name);
  TemporaryFolder(TemporaryFolder&& other) noexcept;
  TemporaryFolder& operator=(TemporaryFolder&&) = delete;
  ~TemporaryFolder();

  const std::filesystem::path& path() const { return path_; }

 private:
  TemporaryFolder(std::filesystem::path path, int lock) : path_(std::move(path)), lock_(lock) {}
  std::filesystem::path path_;  ///< Empty after a move.
  int lock_ = -1;               ///< The open folder.
};

}  // namespace septet::server
