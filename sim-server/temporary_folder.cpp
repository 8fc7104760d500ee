#include "sim-server/temporary_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <utility>

#include <fmt/core.h>

namespace septet::server {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t random_letters = 6;

/// The folder, open and locked; −1 where somebody else holds it, or it is none of this user's.
int lock(const fs::path& folder) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (file < 0) return -1;
  struct stat found {};
  if (::fstat(file, &found) == 0 && found.st_uid == ::geteuid() && ::flock(file, LOCK_EX | LOCK_NB) == 0) return file;
  ::close(file);
  return -1;
}

/// Removes what killed runs have left.
void remove_orphans(const fs::path& parent, const std::string& prefix) {
  std::error_code ignored;
  for (fs::directory_iterator entry(parent, ignored), end; entry != end; entry.increment(ignored)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(prefix) || name.size() != prefix.size() + random_letters) continue;
    const int orphan = lock(entry->path());
    if (orphan < 0) continue;
    fs::remove_all(entry->path(), ignored);
    ::close(orphan);
  }
}

}  // namespace

Expected<TemporaryFolder> TemporaryFolder::make(std::string_view name) {
  const char* const remedy = "free space there or set TMPDIR";
  std::error_code error;
  const fs::path parent = fs::temp_directory_path(error);
  if (error) return failure("there is no folder for temporary files: " + error.message(), "TMPDIR", remedy);
  const std::string prefix = fmt::format("{}-", name);
  remove_orphans(parent, prefix);
  // It gets its name once it is locked, so that nobody takes it for an orphan.
  std::string draft = (parent / fmt::format(".{}{}", prefix, std::string(random_letters, 'X'))).string();
  if (!::mkdtemp(draft.data())) return failure("cannot make a folder for temporary files", draft, remedy);
  const int held = lock(draft);
  const fs::path path = parent / fs::path(draft).filename().string().substr(1);
  fs::rename(draft, path, error);
  if (!error) return TemporaryFolder(path, held);
  if (held >= 0) ::close(held);
  fs::remove_all(draft, error);
  return failure("cannot make a folder for temporary files", path.string(), remedy);
}

TemporaryFolder::TemporaryFolder(TemporaryFolder&& other) noexcept
    : path_(std::exchange(other.path_, {})), lock_(std::exchange(other.lock_, -1)) {}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

}  // namespace septet::server
