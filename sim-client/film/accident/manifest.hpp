#pragma once
/// Record of what the film of an accident was made of and of what it consists, and its check.
///
/// Hashes are StateHash, as the session's own: they find slips, damage and changes, and do not protect against a forger
/// who writes them anew; three frames are drawn again for that.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/document/json.hpp"
#include "engine/image/image.hpp"
#include "logging/session/session_reader.hpp"
#include "sim-client/film/accident/accident_plan.hpp"
#include "sim-client/film/film.hpp"

namespace septet::film {

/// Names within the folder of an accident's film.
inline constexpr const char *film_name = "accident.mp4", *script_name = "storyboard.toml",
                            *subtitles_name = "accident.srt", *page_name = "accident.html",
                            *manifest_name = "accident.json";

/// Sixteen hexadecimal digits.
std::string hash_text(const image::Image& picture);
/// Of a file, read piece by piece. Error: it cannot be read.
Expected<std::string> hash_of_file(const std::filesystem::path& file);

/// Hashes of all pictures of a film file, in order, as ffmpeg decodes them. Error: it is not installed, or cannot read
/// the film.
Expected<std::vector<std::string>> decoded_hashes(const std::filesystem::path& film);

/// The record of a film, from everything that it was made of; `files` lie in `folder`.
struct ManifestSources {
  const FilmOptions& options;
  const logging::SessionReader& session;
  const AccidentFacts& facts;
  const AccidentPlan& plan;
  std::filesystem::path folder;
  std::vector<std::string> files;
  std::vector<std::string> pictures;  ///< hash_text of each frame's picture.
};
Expected<document::Json> manifest(const ManifestSources& sources);

/// The record's members that session and plan decide alone: `title`, `session` without its file, `inputs`, `event`,
/// `contacts`, `left_out`.
document::Json made_of_json(const logging::SessionInfo& session, const AccidentFacts& facts, const AccidentPlan& plan);

/// Figures of a plan as JSON, each with value, unit and origin.
document::Json figures_json(const AccidentPlan& plan);

}  // namespace septet::film
