#pragma once
/// Where a drive writes: its log, pictures, summary and report.

#include <filesystem>

#include "engine/core/expected.hpp"

namespace septet::server {

/// An earlier drive in the folder is moved aside, for a log is never overwritten; one that is going on there, and anything that is
/// no drive, is left alone. The folder belongs to this program (flock) until the object goes or the program ends, however it ends.
class DriveFolder {
 public:
  static Expected<DriveFolder> prepare(const std::filesystem::path& chosen);
  DriveFolder(DriveFolder&& other) noexcept;
  DriveFolder& operator=(DriveFolder&&) = delete;
  ~DriveFolder();

  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& aside() const { return aside_; }  ///< Where the earlier drive is now, if there was one.
  /// Nothing was driven: the earlier drive comes back, unless something has been written here.
  void undo() const;

 private:
  DriveFolder() = default;

  std::filesystem::path path_, aside_;
  int lock_ = -1;  ///< The folder, open and locked; −1 on a file system without locks.
};

}  // namespace septet::server
