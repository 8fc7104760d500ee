#pragma once
/// Output folder of a drive: its log, pictures, summary and report.

#include <filesystem>

#include "engine/core/expected.hpp"

namespace septet::server {

/// An earlier drive in the folder is moved aside, since a log is never overwritten; a running drive, and anything that
/// is not a drive, is left alone. The folder belongs to this program (flock) until the object goes or the program ends,
/// in any manner.
class DriveFolder {
 public:
  static Expected<DriveFolder> prepare(const std::filesystem::path& chosen);
  DriveFolder(DriveFolder&& other) noexcept;
  DriveFolder& operator=(DriveFolder&&) = delete;
  ~DriveFolder();

  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& aside() const { return aside_; }  ///< New place of the earlier drive, if there was one.
  /// Nothing was driven: restores the earlier drive, unless files were written here.
  void undo() const;

 private:
  DriveFolder() = default;

  std::filesystem::path path_, aside_;
  int lock_ = -1;  ///< The folder, open and locked; −1 on a file system without locks.
};

}  // namespace septet::server
