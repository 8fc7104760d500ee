#include "sim-client/film/film_file.hpp"

#include <algorithm>
#include <chrono>

#include <fmt/core.h>

#include "engine/document/text_file.hpp"
#include "program/child_process.hpp"
#include "program/last_line.hpp"

namespace septet::film {
namespace fs = std::filesystem;
namespace {

/// In ffmpeg's file list a quote ends the name: it stands outside of quotes.
std::string quoted(const std::string& name) {
  std::string text = "'";
  for (const char c : name) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + "'";
}

}  // namespace

Expected<bool> is_film_file(const fs::path& name) {
  const std::string extension = name.extension().string();
  if (extension == ".mp4" || extension == ".mkv") return true;
  for (const char* other : {".mov", ".avi", ".webm", ".m4v", ".mpg", ".mpeg", ".gif"})
    if (extension == other)
      return failure("Septet makes no " + extension, name.string(), "write .mp4 (H.264) or .mkv (FFV1, without loss)");
  return false;
}

Expected<fs::path> pictures_folder(const fs::path& name) {
  const auto is_file = is_film_file(name);
  if (!is_file) return tl::unexpected(is_file.error());
  return *is_file ? fs::path(name.string() + ".pictures") : name;
}

Expected<fs::path> find_ffmpeg() {
  if (auto found = program::find_program("ffmpeg")) return *found;
  return failure("there is no ffmpeg, which makes a film of pictures", "--out",
                 "install the package ffmpeg, or choose a folder for the pictures alone");
}

Expected<bool> encode_film(const fs::path& ffmpeg, std::span<const fs::path> pictures, const fs::path& sound,
                           double frames_per_second, const fs::path& film, const std::function<bool()>& go_on) {
  const fs::path folder = pictures.front().parent_path(), list = folder / "pictures.txt", log = folder / "ffmpeg.txt";
  const fs::path part = film.string() + ".part";
  std::string text = "ffconcat version 1.0\n";
  for (const fs::path& picture : pictures) text += "file " + quoted(picture.filename().string()) + "\n";
  if (auto written = document::write_text_file(list, text); !written) return tl::unexpected(written.error());
  std::error_code ignored;
  fs::remove(log, ignored);
  // Pictures are full-range sRGB; the film states its colour space, or players guess.
  std::vector<std::string> arguments{"-nostdin",
                                     "-hide_banner",
                                     "-loglevel",
                                     "error",
                                     "-y",
                                     "-f",
                                     "concat",
                                     "-safe",
                                     "0",
                                     "-r",
                                     fmt::format("{}", frames_per_second),
                                     "-i",
                                     "file:" + list.string()};
  const auto add = [&](std::initializer_list<const char*> more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
  };
  if (!sound.empty()) {
    arguments.insert(arguments.end(), {"-i", "file:" + sound.string()});
    add({"-map", "0:v", "-map", "1:a", "-shortest"});
    film.extension() == ".mkv" ? add({"-c:a", "flac"}) : add({"-c:a", "aac", "-b:a", "192k"});
  }
  if (film.extension() == ".mkv")
    add({"-c:v", "ffv1", "-level", "3", "-pix_fmt", "bgr0", "-f", "matroska"});
  else
    add({"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv,format=yuv420p", "-c:v",
         "libx264", "-crf", "18", "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "iec61966-2-1",
         "-color_range", "tv", "-movflags", "+faststart", "-f", "mp4"});
  arguments.push_back("file:" + part.string());
  auto child = program::ChildProcess::start({ffmpeg.string(), std::move(arguments), {}, log});
  if (!child) return tl::unexpected(child.error());
  std::optional<program::ChildExit> end;
  while (!(end = child->poll())) {
    if (!go_on()) {
      child->stop();
      fs::remove(part, ignored);
      return false;
    }
    child->read_line(std::chrono::milliseconds(100));
  }
  if (end->code != 0) {
    fs::remove(part, ignored);
    const std::string why = program::last_line(log);
    return failure("ffmpeg has made no film of the pictures: " + (why.empty() ? "it says nothing" : why), film.string(),
                   "the pictures are in " + folder.string() + "; add --resume to try again");
  }
  std::error_code error;
  fs::rename(part, film, error);
  if (error) return failure(error.message(), film.string(), "the film is in " + part.string());
  fs::remove(list, ignored);
  fs::remove(log, ignored);
  return true;
}

}  // namespace septet::film
