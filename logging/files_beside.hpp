#pragma once
/// What lies beside an SQLite file and is obeyed when it is opened: the journal of a change that was cut off (NAME-journal), and
/// the newest commits of a drive (NAME-wal, with its index NAME-shm).
///
/// A journal may name a second file, its "super-journal", for changes to several databases at once; SQLite deletes that file when
/// it rolls the journal back. Septet changes one database at a time, so such a journal is not its own. Source:
/// sqlite.org/fileformat.html, "The Rollback Journal"; sqlite.org/wal.html, "Read-Only Databases".

#include <cstdint>
#include <filesystem>
#include <utility>

#include "engine/core/expected.hpp"

namespace septet::logging {

/// How a file can be read so that nothing in its folder changes.
enum class ReadWay {
  shared,     ///< As it is, with locks: whoever changes it waits for us.
  immutable,  ///< As it is, without locks: nobody writes it.
  with_wal,   ///< With the newest commits of a drive that goes on, or was killed; the index is only read.
  copied,     ///< A copy of our own, in which what was cut off is rolled back or folded in.
};

/// Error: what lies beside it is not Septet's.
Expected<ReadWay> way_to_read(const std::filesystem::path& database);

/// Error: the journal beside it is one that SQLite must not see. Before a file is opened to be changed.
Expected<void> check_journal(const std::filesystem::path& database);

/// A folder that only this user can enter; gone with the value.
class PrivateFolder {
 public:
  static Expected<PrivateFolder> create();
  PrivateFolder(PrivateFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  PrivateFolder& operator=(PrivateFolder&&) = delete;
  ~PrivateFolder();
  const std::filesystem::path& path() const { return path_; }

 private:
  explicit PrivateFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
};

/// Journal and WAL larger than this are not copied: a drive of eight hours whose every commit lies in its WAL has less. A file of holes that
/// somebody sent would fill the disk.
inline constexpr std::uintmax_t most_copied_bytes = std::uintmax_t{4} << 30;

/// Copies the database, its journal and its WAL to `folder`/copy.sqlite, all as they were at one moment, and returns that.
/// Error: they are larger than most_copied_bytes, there is no room for it, or it changed all the time.
Expected<std::filesystem::path> copy_with_files_beside(const std::filesystem::path& database,
                                                       const PrivateFolder& folder);

}  // namespace septet::logging
