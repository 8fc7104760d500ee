#pragma once
/// Files beside an SQLite file that take effect when it is opened: the journal of an interrupted change (NAME-journal),
/// and the newest commits of a drive (NAME-wal, with its index NAME-shm).
///
/// A journal may name a second file, its "super-journal", for changes to several databases at once; SQLite deletes that
/// file when it rolls the journal back. Septet changes one database at a time, so such a journal is not its own.
/// Source: sqlite.org/fileformat.html, "The Rollback Journal"; sqlite.org/wal.html, "Read-Only Databases".

#include <cstdint>
#include <filesystem>
#include <utility>

#include "engine/core/expected.hpp"

namespace septet::logging {

/// Methods of reading a file without changing its folder.
enum class ReadWay {
  shared,     ///< In place, with locks: a writer waits for the reader.
  immutable,  ///< In place, without locks: the file has no writer.
  with_wal,   ///< With the newest commits of a running or killed drive; the index is only read.
  copied,     ///< A private copy, in which interrupted changes are rolled back or folded in.
};

/// Error: a file beside it is not Septet's.
Expected<ReadWay> way_to_read(const std::filesystem::path& database);

/// To be called before a file is opened for changes. Error: the journal beside it is one that SQLite must not see.
Expected<void> check_journal(const std::filesystem::path& database);

/// A folder that only this user can enter; removed by the destructor.
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

/// Journal and WAL larger than this are not copied: a drive of eight hours whose every commit lies in its WAL has less,
/// and a sparse file from somebody else would fill the disk.
inline constexpr std::uintmax_t most_copied_bytes = std::uintmax_t{4} << 30;

/// Copies the database, its journal and its WAL to `folder`/copy.sqlite, all from one moment, and returns its path.
/// Error: they are larger than most_copied_bytes, no room, or it changed all the time.
Expected<std::filesystem::path> copy_with_files_beside(const std::filesystem::path& database,
                                                       const PrivateFolder& folder);

}  // namespace septet::logging
