#include "logging/session/files_beside.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <system_error>

#include <fmt/core.h>

namespace septet::logging {
namespace {
namespace fs = std::filesystem;

/// Magic bytes that begin a journal, and end one that names a super-journal.
constexpr std::array<unsigned char, 8> journal_magic = {0xd9, 0xd5, 0x05, 0xf9, 0x20, 0xa1, 0x63, 0xd7};
/// First bytes of a WAL, but for the last bit, which tells the byte order of its checksums; without them SQLite reads
/// nothing of one.
constexpr std::array<unsigned char, 4> wal_magic = {0x37, 0x7f, 0x06, 0x82};
constexpr off_t write_version_at = 18;  ///< Offset in the database's header; value 2: its newest commits are in a WAL.

fs::path beside(const fs::path& database, const char* ending) { return database.string() + ending; }

std::optional<struct stat> found_at(const fs::path& path) {
  struct stat found {};
  if (::lstat(path.c_str(), &found) != 0) return std::nullopt;
  return found;
}

/// Bytes from a place on, counted from the end where it is negative; fewer where there are no more.
std::string bytes_at(const fs::path& path, off_t from, std::size_t count) {
  std::string bytes(count, '\0');
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
  if (file < 0) return {};
  const off_t size = ::lseek(file, 0, SEEK_END);
  const ssize_t read = ::pread(file, bytes.data(), count, from < 0 ? std::max<off_t>(size + from, 0) : from);
  ::close(file);
  bytes.resize(read < 0 ? 0 : static_cast<std::size_t>(read));
  return bytes;
}

bool is_magic(const std::string& bytes) {
  return bytes.size() == journal_magic.size() && std::memcmp(bytes.data(), journal_magic.data(), bytes.size()) == 0;
}

/// True if SQLite would roll the journal back. Error: it is not Septet's.
Expected<bool> has_hot_journal(const fs::path& database) {
  const fs::path journal = beside(database, "-journal");
  const auto found = found_at(journal);
  if (!found) return false;
  if (!S_ISREG(found->st_mode))
    return failure("the session's journal is not a regular file", journal.string(), "delete it if nobody needs it");
  if (is_magic(bytes_at(journal, -static_cast<off_t>(journal_magic.size()), journal_magic.size())))
    return failure(
        "this journal names another file, which would be deleted when the session is opened: it is not Septet's",
        journal.string(), "do not trust who sent it; without this journal the session can be read");
  const std::string first = bytes_at(journal, 0, 1);
  if (first.empty() && found->st_size > 0)
    return failure("the journal beside the session cannot be read", journal.string(), "check its permissions");
  return !first.empty() && first[0] != '\0';
}

/// True if SQLite would read commits from it.
bool is_wal(const fs::path& path) {
  std::string bytes = bytes_at(path, 0, wal_magic.size());
  if (bytes.size() != wal_magic.size()) return false;
  bytes.back() = static_cast<char>(bytes.back() & ~1);
  return std::memcmp(bytes.data(), wal_magic.data(), bytes.size()) == 0;
}

/// True for the same file with the same content, as far as the file system tells.
bool is_unchanged(const std::optional<struct stat>& before, const std::optional<struct stat>& after) {
  if (!before || !after) return !before && !after;
  return before->st_ino == after->st_ino && before->st_size == after->st_size &&
         before->st_mtim.tv_sec == after->st_mtim.tv_sec && before->st_mtim.tv_nsec == after->st_mtim.tv_nsec;
}

}  // namespace

Expected<void> check_journal(const fs::path& database) {
  return has_hot_journal(database).map([](bool) {});
}

Expected<ReadWay> way_to_read(const fs::path& database) {
  const auto is_hot = has_hot_journal(database);
  if (!is_hot) return tl::unexpected(is_hot.error());
  const fs::path wal = beside(database, "-wal"), index = beside(database, "-shm");
  const auto wal_found = found_at(wal), index_found = found_at(index);
  for (const auto& [found, path] : {std::pair(wal_found, wal), {index_found, index}})
    if (found && !S_ISREG(found->st_mode))
      return failure("the session's WAL or its index is not a regular file", path.string(),
                     "delete it if nobody needs it");
  if (*is_hot) return ReadWay::copied;
  if (wal_found && index_found) return ReadWay::with_wal;
  if (wal_found && is_wal(wal)) return ReadWay::copied;
  const std::string version = bytes_at(database, write_version_at, 2);
  return wal_found || version.find('\2') != std::string::npos ? ReadWay::immutable : ReadWay::shared;
}

Expected<PrivateFolder> PrivateFolder::create() {
  std::error_code error;
  const fs::path place = fs::temp_directory_path(error);
  std::string name = (place / "septet-read-XXXXXX").string();
  if (error || !::mkdtemp(name.data()))
    return failure(fmt::format("no folder can be made for a copy: {}", std::strerror(errno)), place.string(),
                   "name a folder that can be written in the environment's TMPDIR");
  return PrivateFolder(name);
}

PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

Expected<fs::path> copy_with_files_beside(const fs::path& database, const PrivateFolder& folder) {
  const fs::path copy = folder.path() / "copy.sqlite";
  constexpr std::array endings = {"-journal", "-wal", ""};
  for (int attempt = 0; attempt < 5; ++attempt) {
    std::array<std::optional<struct stat>, endings.size()> before;
    bool is_one_moment = true;
    std::error_code error;
    for (std::size_t i = 0; i < endings.size(); ++i) before[i] = found_at(beside(database, endings[i]));
    std::uintmax_t bytes = 0;
    for (const auto& found : before) bytes += found ? static_cast<std::uintmax_t>(found->st_size) : 0;
    if (const auto beside_it = bytes - (before.back() ? static_cast<std::uintmax_t>(before.back()->st_size) : 0);
        beside_it > most_copied_bytes)
      return failure(
          fmt::format("beside the session lie {:.0f} MB of changes that belong to it, and up to {:.0f} MB are "
                      "copied to be read",
                      1e-6 * static_cast<double>(beside_it), 1e-6 * static_cast<double>(most_copied_bytes)),
          database.string(), "if you trust who sent it, join them: sqlite3 FILE 'PRAGMA journal_mode=DELETE'");
    if (const auto room = fs::space(folder.path(), error); !error && room.available < bytes)
      return failure(fmt::format("a copy of {:.0f} MB has no room in {}, and without one the session cannot be read",
                                 1e-6 * static_cast<double>(bytes), folder.path().parent_path().string()),
                     database.string(), "free some space, or name another folder in the environment's TMPDIR");
    for (std::size_t i = 0; i < endings.size(); ++i) {
      const fs::path to = beside(copy, endings[i]);
      fs::remove(to, error);
      if (!before[i]) continue;
      // A link in place of a journal was refused; the database itself may be one, and it is followed.
      if (!fs::copy_file(beside(database, endings[i]), to, error)) is_one_moment = false;
    }
    for (std::size_t i = 0; i < endings.size(); ++i)
      is_one_moment &= is_unchanged(before[i], found_at(beside(database, endings[i])));
    if (!is_one_moment) continue;
    // The copy is the file that will be opened: it is checked again.
    return check_journal(copy).map([&] { return copy; });
  }
  return failure("the session cannot be copied, or changes all the time", database.string(),
                 "wait until nobody writes it, and free some space in the environment's TMPDIR");
}

}  // namespace septet::logging
