#include "sim-client/film/film_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "engine/core/hash.hpp"
#include "engine/core/regular_file.hpp"
#include "engine/core/version.hpp"
#include "engine/document/json.hpp"
#include "engine/document/text_file.hpp"
#include "engine/exr/exr.hpp"
#include "engine/image/png.hpp"
#include "logging/session/session_reader.hpp"
#include "program/clock.hpp"
#include "program/stop_signal.hpp"
#include "sim-client/film/traced/layers.hpp"

namespace septet::film {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t longest_record_bytes = 1 << 20;
constexpr double patience_s = 60.0;  ///< Grace for programs to end after their mpirun, or another parent, is gone.

std::string hash_of(std::string_view text) {
  StateHash hash;
  hash.add_bytes(std::as_bytes(std::span(text)));
  return fmt::format("{:016x}", hash.value());
}

/// When a session was driven, and a hash of what it was driven with.
std::string identity_of(const logging::SessionInfo& session) {
  std::string drive = session.git_revision;
  for (const auto& [name, seed] : session.seeds) drive += fmt::format("\n{} {}", name, seed);
  for (const auto& [name, value] : session.other) drive += fmt::format("\n{} {}", name, value);
  for (const auto& file : session.files) drive += fmt::format("\n{}\n{}", file.role, file.content);
  return fmt::format("{} {}", session.started_utc, hash_of(drive));
}

Expected<std::string> ghosts_of(const FilmOptions& options) {
  std::string ghosts;
  for (const fs::path& path : options.ghosts) {
    const auto session = logging::SessionReader::open(path);
    if (!session) return tl::unexpected(session.error());
    ghosts += (ghosts.empty() ? "" : ", ") + identity_of(session->info());
  }
  return ghosts;
}

/// Session and, for a film without a script, the stretch of it that is shown.
Expected<std::string> shots_of(const FilmOptions& options) {
  if (!options.shots.empty()) return read_regular_file(options.shots, longest_record_bytes).map(hash_of);
  const auto text = [](const std::optional<double>& time_s) { return time_s ? fmt::format("{} s", *time_s) : "end"; };
  return text(options.from_s) + " to " + text(options.to_s);
}

Expected<FilmRecord> read_record(const fs::path& file) {
  const auto text = read_regular_file(file, longest_record_bytes);
  if (!text) return tl::unexpected(text.error());
  FilmRecord record;
  const auto json = document::Json::parse(*text, nullptr, false);
  if (!json.is_object()) return failure("it is not a film's record", file.string(), "choose a new folder with --out");
  for (const auto& [name, value] : json.items()) record[name] = value.is_string() ? value.get<std::string>() : "";
  return record;
}

/// Names the first difference to the film in the folder.
Expected<void> check_is_same(const FilmRecord& film, const fs::path& file) {
  const auto begun = read_record(file);
  if (!begun) return tl::unexpected(begun.error());
  for (const auto& [name, value] : film) {
    const auto there = begun->find(name);
    if (there == begun->end() || there->second != value)
      return failure(fmt::format("the film that was begun there has another {}: {}, not {}", name,
                                 there == begun->end() ? "none" : there->second, value),
                     file.string(), "give the same options as then, or choose a new folder with --out");
  }
  return {};
}

}  // namespace

Expected<FilmRecord> film_record(const FilmOptions& options, const logging::SessionInfo& session) {
  const auto shots = shots_of(options);
  if (!shots) return tl::unexpected(shots.error());
  const auto ghosts = ghosts_of(options);
  if (!ghosts) return tl::unexpected(ghosts.error());
  FilmRecord record{{"septet", version_text()},
                    {"session", identity_of(session)},
                    {"shots", *shots},
                    {"ghosts", *ghosts},
                    {"frames_per_second", fmt::format("{}", options.frames_per_second)},
                    {"size", fmt::format("{}x{}", options.width_px, options.height_px)},
                    {"renderer", options.renderer == FilmRenderer::traced ? "traced" : "raster"}};
  if (options.renderer == FilmRenderer::traced) {
    record["samples"] = fmt::format("{}", options.samples);
    record["sample_sets"] = fmt::format("{}", options.sample_sets);
    record["error"] = fmt::format("{}", options.error);
    record["caustic_photons"] = fmt::format("{}", options.caustic_photons);
    record["gather_photons"] = fmt::format("{}", options.gather_photons);
    record["denoise"] = options.denoise ? "yes" : "no";
    record["filter"] = fmt::format("{}", static_cast<int>(options.filter));
    record["exr"] = options.exr == ExrNumbers::none             ? "none"
                    : options.exr == ExrNumbers::half_precision ? "half"
                                                                : "float";
    record["layers"] = layers_text(options.layers);
  } else {
    record["drawn_by"] = options.software ? "processor" : "graphics card, if there is one";
  }
  return record;
}

std::optional<FilmRecord> begun_in(const fs::path& folder) {
  auto record = read_record(folder / "film.json");
  return record ? std::optional(std::move(*record)) : std::nullopt;
}

Expected<void> FilmFolder::check_is_free(const fs::path& path, bool resume) {
  std::error_code error;
  if (!fs::exists(path, error) || (fs::is_directory(path, error) && fs::is_empty(path, error))) return {};
  const bool begun = fs::is_regular_file(path / "film.json", error);
  if (begun && resume) return {};
  return failure(
      begun ? "a film was begun there already" : "it is there already and not an empty folder", path.string(),
      begun ? "add --resume to go on with it, or choose a new folder with --out" : "choose a new folder with --out");
}

Expected<FilmFolder> FilmFolder::open(const fs::path& path, const FilmRecord& film, bool resume) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) return failure(error.message(), path.string(), "choose a folder that can be written with --out");
  FilmFolder folder(path);
  folder.lock_ = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder.lock_ >= 0 && ::flock(folder.lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    return failure("another program draws a film there now", path.string(),
                   "wait for its end, or choose another folder with --out");
  const fs::path record = path / "film.json";
  if (auto is_free = check_is_free(path, resume); !is_free) return tl::unexpected(is_free.error());
  if (fs::exists(record, error)) {
    if (auto same = check_is_same(film, record); !same) return tl::unexpected(same.error());
    // Removes half-written files of a killed program.
    for (const fs::directory_entry& entry : fs::directory_iterator(path, error))
      if (entry.path().extension() == ".part") fs::remove(entry.path(), error);
    fs::remove(path / "preview.png", error);
    return folder;
  }
  document::Json json = document::Json::object();
  for (const auto& [name, value] : film) json[name] = value;
  if (auto written = document::write_text_file(record, document::text_of(json)); !written)
    return tl::unexpected(written.error());
  return folder;
}

void FilmFolder::wait_until_free(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  const double until_s = program::monotonic_s() + patience_s;
  while (::flock(file, LOCK_EX | LOCK_NB) != 0 && program::monotonic_s() < until_s && !program::stop_signal())
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  ::close(file);
}

FilmFolder::FilmFolder(FilmFolder&& other) noexcept
    : path_(std::move(other.path_)), lock_(std::exchange(other.lock_, -1)) {}

FilmFolder::~FilmFolder() {
  if (lock_ >= 0) ::close(lock_);
}

fs::path FilmFolder::picture(std::uint64_t number) const { return path_ / fmt::format("{:06}.png", number); }

fs::path FilmFolder::exr_picture(std::uint64_t number) const { return path_ / fmt::format("{:06}.exr", number); }

bool FilmFolder::has(std::uint64_t number, const FilmOptions& options) const {
  std::error_code error;
  if (!fs::is_regular_file(picture(number), error)) return false;
  const auto read = image::read_png(picture(number));
  if (!read || read->width != options.width_px || read->height != options.height_px) return false;
  return options.exr == ExrNumbers::none || exr::is_whole(exr_picture(number), options.width_px, options.height_px);
}

}  // namespace septet::film
