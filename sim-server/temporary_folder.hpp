#pragma once
/// A folder for files that only one run needs: made empty, readable by this user alone, and gone with all that is in it.

#include <filesystem>
#include <string_view>

#include "engine/core/expected.hpp"

namespace septet::server {

class TemporaryFolder {
 public:
  /// Below TMPDIR, named `name` and six random letters. Error: no folder can be made there.
  static Expected<TemporaryFolder> make(std::string_view name);
  TemporaryFolder(TemporaryFolder&& other) noexcept;
  TemporaryFolder& operator=(TemporaryFolder&&) = delete;
  ~TemporaryFolder();

  const std::filesystem::path& path() const { return path_; }

 private:
  explicit TemporaryFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;  ///< Empty after a move.
};

}  // namespace septet::server
