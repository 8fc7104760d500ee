#pragma once
/// A folder for the files of one run: created empty, readable by this user alone, and removed with its content.
///
/// A killed run cannot remove it; a small process of its own, which only waits for the run's end, does. If that one is
/// killed too, the next run removes the remains: a living run holds a lock (flock) on its own folder.

#include <sys/types.h>

#include <filesystem>
#include <string_view>

#include "engine/core/expected.hpp"

namespace septet::program {

class TemporaryFolder {
 public:
  /// Below TMPDIR, named `name`, a hyphen, six random letters and ".run". Error: no folder can be created there.
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
  pid_t keeper_ = -1;           ///< The process that waits for it; −1: not started.
};

}  // namespace septet::program
