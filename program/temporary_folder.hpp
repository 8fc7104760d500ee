#pragma once
/// A folder for files that only one run needs: made empty, readable by this user alone, and gone with all that is in it.
///
/// A run that is killed cannot remove anything; a small process of its own, which only waits for the run's end, does. Where that
/// one is killed too, the next run removes what is left: a living run holds a lock (flock) on its own folder.

#include <sys/types.h>

#include <filesystem>
#include <string_view>

#include "engine/core/expected.hpp"

namespace septet::program {

class TemporaryFolder {
 public:
  /// Below TMPDIR, named `name`, a hyphen, six random letters and ".run". Error: no folder can be made there.
  static Expected<TemporaryFolder> make(std::string_view name);
  TemporaryFolder(TemporaryFolder&& other) noexcept;
  TemporaryFolder& operator=(TemporaryFolder&&) = delete;
  ~TemporaryFolder();

  const std::filesystem::path& path() const { return path_; }

 private:
  TemporaryFolder(std::filesystem::path path, int lock);
  std::filesystem::path path_;  ///< Empty after a move.
  int lock_ = -1;               ///< The open folder.
  int alive_ = -1;              ///< A pipe's end that the system closes with this run.
  pid_t keeper_ = -1;           ///< Who waits for that; −1: nobody.
};

}  // namespace septet::program
