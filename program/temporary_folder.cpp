#include "program/temporary_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string>
#include <utility>

#include <fmt/core.h>

namespace septet::program {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view random_letters = "XXXXXX";
constexpr std::string_view ending = ".run";  // Only these folders have it: others with the same prefix are not orphans.

/// The folder, open and locked; −1 if another process holds it, or it is not this user's.
int lock(const fs::path& folder) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (file < 0) return -1;
  struct stat found {};
  if (::fstat(file, &found) == 0 && found.st_uid == ::geteuid() && ::flock(file, LOCK_EX | LOCK_NB) == 0) return file;
  ::close(file);
  return -1;
}

/// Removes the remains of killed runs.
void remove_orphans(const fs::path& parent, const std::string& prefix) {
  std::error_code ignored;
  for (fs::directory_iterator entry(parent, ignored), end; entry != end; entry.increment(ignored)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(prefix) || !name.ends_with(ending) ||
        name.size() != prefix.size() + random_letters.size() + ending.size())
      continue;
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
  // Renamed once it is locked, so that it is never mistaken for an orphan.
  std::string draft = (parent / fmt::format(".{}{}", prefix, random_letters)).string();
  if (!::mkdtemp(draft.data())) return failure("cannot make a folder for temporary files", draft, remedy);
  const int held = lock(draft);
  const fs::path path = parent / fmt::format("{}{}", fs::path(draft).filename().string().substr(1), ending);
  fs::rename(draft, path, error);
  if (!error) return TemporaryFolder(path, held);
  if (held >= 0) ::close(held);
  fs::remove_all(draft, error);
  return failure("cannot make a folder for temporary files", path.string(), remedy);
}

TemporaryFolder::TemporaryFolder(fs::path path, int lock) : path_(std::move(path)), lock_(lock) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return;
  keeper_ = ::fork();
  if (keeper_ == 0) {
    ::setsid();  // Unaffected by Ctrl-C and by a closing terminal.
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::signal(signal, SIG_IGN);
    // Keeps no descriptor of the run open, least of all the pipe's other end.
    ::dup2(ends[0], STDIN_FILENO);
    ::close_range(STDOUT_FILENO, ~0u, 0);
    char nothing;
    while (::read(STDIN_FILENO, &nothing, 1) < 0 && errno == EINTR) {
    }
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    ::_exit(0);
  }
  ::close(ends[0]);
  alive_ = ends[1];
}

TemporaryFolder::TemporaryFolder(TemporaryFolder&& other) noexcept
    : path_(std::exchange(other.path_, {})),
      lock_(std::exchange(other.lock_, -1)),
      alive_(std::exchange(other.alive_, -1)),
      keeper_(std::exchange(other.keeper_, -1)) {}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
  if (lock_ >= 0) ::close(lock_);
  if (alive_ >= 0) ::close(alive_);
  if (keeper_ > 0) ::waitpid(keeper_, nullptr, 0);
}

}  // namespace septet::program
