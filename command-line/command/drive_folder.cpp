#include "command-line/command/drive_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include <fmt/core.h>

namespace septet::server {
namespace fs = std::filesystem;
namespace {

/// The folder, open and locked, or −1 if it cannot be locked. Error: another process holds it.
Expected<int> lock(const fs::path& folder) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0 || ::flock(file, LOCK_EX | LOCK_NB) == 0) return file;
  const bool is_held = errno == EWOULDBLOCK;
  ::close(file);
  if (is_held)
    return failure("another drive is going on in this folder", folder.string(),
                   "wait for its end, or choose another folder with --out");
  return -1;
}

}  // namespace

Expected<DriveFolder> DriveFolder::prepare(const fs::path& chosen) {
  DriveFolder folder;
  folder.path_ = chosen.lexically_normal();
  if (!folder.path_.has_filename()) folder.path_ = folder.path_.parent_path();  // "out/" is "out".
  std::error_code error;
  const auto kind = fs::status(folder.path_, error).type();
  if (kind != fs::file_type::directory && kind != fs::file_type::not_found)
    return failure(kind == fs::file_type::none ? error.message() : "it is a file, not a folder", chosen.string(),
                   "choose a folder for the drive with --out");
  if (kind == fs::file_type::directory && !fs::is_empty(folder.path_, error)) {
    if (!fs::exists(folder.path_ / "session.sqlite", error) && !fs::exists(folder.path_ / "screens", error))
      return failure("the folder holds other things than an earlier drive", chosen.string(),
                     "choose a new or empty one with --out");
    const auto earlier = lock(folder.path_);
    if (!earlier) return tl::unexpected(earlier.error());
    for (int number = 1; folder.aside_.empty() || fs::exists(folder.aside_, error); ++number)
      folder.aside_ = fmt::format("{}.{}", folder.path_.string(), number);
    fs::rename(folder.path_, folder.aside_, error);
    if (*earlier >= 0) ::close(*earlier);
    if (error) return failure(error.message(), chosen.string(), "move the earlier drive there out of the way");
  }
  fs::create_directories(folder.path_ / "screens", error);
  if (error) {
    const auto reason = error.message();
    folder.undo();
    return failure(reason, chosen.string(), "choose a folder that can be written with --out");
  }
  const auto held = lock(folder.path_);
  if (!held) return tl::unexpected(held.error());
  folder.lock_ = *held;
  return folder;
}

DriveFolder::DriveFolder(DriveFolder&& other) noexcept
    : path_(std::move(other.path_)), aside_(std::move(other.aside_)), lock_(std::exchange(other.lock_, -1)) {}

DriveFolder::~DriveFolder() {
  if (lock_ >= 0) ::close(lock_);
}

void DriveFolder::undo() const {
  std::error_code ignored;
  fs::remove(path_ / "screens", ignored);
  fs::remove(path_, ignored);
  if (!aside_.empty() && !fs::exists(path_, ignored)) fs::rename(aside_, path_, ignored);
}

}  // namespace septet::server
