#pragma once
/// The folder that the pictures of a film are drawn into, by one program at a time, and what film it is.
///
/// film.json says what all pictures depend on; who goes on with a film that was begun must say the same. A picture has its name,
/// NNNNNN.png, only once it is whole (frame/picture_writer.hpp); one that cannot be read all the same, as after a power cut, is
/// drawn again.

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "engine/core/expected.hpp"
#include "logging/records.hpp"
#include "sim-client/film/film.hpp"

namespace septet::film {

/// What all pictures of a film depend on, by name: "size" → "1280x720".
using FilmRecord = std::map<std::string, std::string>;
/// What film was begun in the folder; nothing where there is none.
std::optional<FilmRecord> begun_in(const std::filesystem::path& folder);
Expected<FilmRecord> film_record(const FilmOptions& options, const logging::SessionInfo& session);

class FilmFolder {
 public:
  /// The folder is to be made, or empty; where `resume`, the same film may have been begun there.
  static Expected<void> check_is_free(const std::filesystem::path& path, bool resume);
  /// Makes the folder, or takes what was begun there. Error: it cannot be written, another film was begun there, or somebody
  /// draws there now.
  static Expected<FilmFolder> open(const std::filesystem::path& path, const FilmRecord& film, bool resume);
  /// Until nobody draws there any more; not for ever, for whoever was told to end may hang.
  static void wait_until_free(const std::filesystem::path& path);
  FilmFolder(FilmFolder&& other) noexcept;
  FilmFolder& operator=(FilmFolder&&) = delete;
  ~FilmFolder();

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path picture(std::uint64_t number) const;
  std::filesystem::path exr_picture(std::uint64_t number) const;
  /// Whether the picture is there, whole, of this size; and its OpenEXR one, where the film has them.
  bool has(std::uint64_t number, const FilmOptions& options) const;

 private:
  explicit FilmFolder(std::filesystem::path path) : path_(std::move(path)) {}

  std::filesystem::path path_;
  int lock_ = -1;  ///< The open folder.
};

}  // namespace septet::film
