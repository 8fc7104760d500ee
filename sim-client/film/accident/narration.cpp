#include "sim-client/film/accident/narration.hpp"

#include <chrono>
#include <cmath>
#include <optional>
#include <system_error>
#include <utility>

#include <fmt/core.h>

#include "program/child_process.hpp"
#include "program/last_line.hpp"
#include "program/temporary_folder.hpp"
#include "sim-client/film/film_file.hpp"

namespace septet::film {
namespace fs = std::filesystem;
namespace {

/// Waits for a program's end. Error: it has failed; `what` is said of it.
Expected<void> finished(const program::ChildOptions& options, const std::string& what, const std::string& remedy) {
  auto child = program::ChildProcess::start(options);
  if (!child) return tl::unexpected(child.error());
  std::optional<program::ChildExit> end;
  while (!(end = child->poll())) child->read_line(std::chrono::milliseconds(50));
  if (end->code == 0) return {};
  const std::string why = program::last_line(options.log);
  return failure(fmt::format("it ends with status {}: {}", end->code, why.empty() ? "it says nothing" : why), what,
                 remedy);
}

}  // namespace

Expected<void> narrate(const fs::path& film, bool has_sound, const std::vector<Spoken>& spoken,
                       const std::string& command) {
  const auto ffmpeg = find_ffmpeg();
  if (!ffmpeg) return tl::unexpected(ffmpeg.error());
  const auto folder = program::TemporaryFolder::make("septet-voice");
  if (!folder) return tl::unexpected(folder.error());
  const fs::path log = folder->path() / "log.txt";
  std::vector<std::string> arguments{"-nostdin", "-hide_banner",         "-loglevel", "error", "-y",
                                     "-i",       "file:" + film.string()};
  std::string mixed = has_sound ? "[0:a]" : "", delayed;
  std::size_t voices = 0;
  for (const Spoken& one : spoken) {
    const fs::path wav = folder->path() / fmt::format("{}.wav", ++voices);
    auto said = finished({"/bin/sh", {"-c", command}, {{"WORDS", one.words}, {"WAV", wav.string()}}, log},
                         "--voice " + command, "let it read its words from $WORDS and write a WAV file, $WAV");
    if (!said) return said;
    std::error_code error;
    if (!fs::is_regular_file(wav, error))
      return failure("it has written no file", "--voice " + command, "let it write a WAV file of the name $WAV");
    arguments.insert(arguments.end(), {"-i", "file:" + wav.string()});
    delayed += fmt::format("[{}:a]adelay={}:all=1[v{}];", voices, std::lround(1000.0 * one.from_s), voices);
    mixed += fmt::format("[v{}]", voices);
  }
  if (voices == 0) return {};
  const fs::path part = film.string() + ".voice";
  const std::string graph =
      fmt::format("{}{}amix=inputs={}:normalize=0,apad[a]", delayed, mixed, voices + (has_sound ? 1 : 0));
  arguments.insert(arguments.end(),
                   {"-filter_complex", graph, "-map", "0:v", "-map", "[a]", "-shortest", "-c:v", "copy", "-c:a", "aac",
                    "-b:a", "192k", "-movflags", "+faststart", "-f", "mp4", "file:" + part.string()});
  std::error_code error;
  auto added = finished({ffmpeg->string(), std::move(arguments), {}, log}, film.string(),
                        "see that the command writes WAV files that ffmpeg reads");
  if (added) fs::rename(part, film, error);
  if (!added || error) {
    std::error_code ignored;
    fs::remove(part, ignored);
  }
  if (error) return failure(error.message(), film.string(), "make room on the disk");
  return added;
}

}  // namespace septet::film
