#pragma once
/// Folder that a film's pictures are drawn into, by one program at a time, and the record of its film.
///
/// film.json holds everything that all pictures depend on; a program that resumes a film must have the same record. A
/// picture gets its name, NNNNNN.png, only once it is whole (frame/picture_writer.hpp); an unreadable one, as after a
/// power cut, is drawn again.

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "engine/core/expected.hpp"
#include "logging/session/records.hpp"
#include "sim-client/film/film.hpp"

namespace septet::film {

/// Everything that all pictures of a film depend on, by name: "size" → "1280x720".
using FilmRecord = std::map<std::string, std::string>;
/// Record of the film in the folder; empty if there is none.
std::optional<FilmRecord> begun_in(const std::filesystem::path& folder);
Expected<FilmRecord> film_record(const FilmOptions& options, const logging::SessionInfo& session);

class FilmFolder {
 public:
  /// Checks that the folder is absent or empty; with `resume`, it may hold the same film.
  static Expected<void> check_is_free(const std::filesystem::path& path, bool resume);
  /// Creates the folder, or takes over its film. Error: not writable, another film lies there, or another program draws
  /// there now.
  static Expected<FilmFolder> open(const std::filesystem::path& path, const FilmRecord& film, bool resume);
  /// Waits until no program draws there; bounded, since a program told to end may hang.
  static void wait_until_free(const std::filesystem::path& path);
  FilmFolder(FilmFolder&& other) noexcept;
  FilmFolder& operator=(FilmFolder&&) = delete;
  ~FilmFolder();

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path picture(std::uint64_t number) const;
  std::filesystem::path exr_picture(std::uint64_t number) const;
  /// True if the picture is there, whole and of this size; and its OpenEXR one, if the film has them.
  bool has(std::uint64_t number, const FilmOptions& options) const;

 private:
  explicit FilmFolder(std::filesystem::path path) : path_(std::move(path)) {}

  std::filesystem::path path_;
  int lock_ = -1;  ///< File descriptor of the open folder.
};

}  // namespace septet::film
