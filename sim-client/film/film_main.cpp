/// `septet-film`: a recorded session to the pictures of a film. `septet film` starts it.

#include <unistd.h>

#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "engine/core/command_line.hpp"
#include "engine/core/version.hpp"
#include "sim-client/film/film.hpp"

namespace septet::film {
namespace {

/// Not fmt::print, which throws where standard error is a file on a full disk.
void say(const std::string& text) { std::fputs(text.c_str(), stderr); }

volatile std::sig_atomic_t stop_requested = 0;
void on_signal(int) { stop_requested = 1; }

/// One line that follows the work, on a terminal in its place.
class ProgressLine {
 public:
  void show(const FilmMade& made) {
    const bool terminal = ::isatty(STDERR_FILENO) != 0;
    const auto now = std::chrono::steady_clock::now();
    if (now - shown_ < (terminal ? std::chrono::milliseconds(100) : std::chrono::seconds(10))) return;
    shown_ = now;
    say(fmt::format("{}{} of {} frames{}", terminal ? "\r\033[K" : "", made.frames, made.planned, terminal ? "" : "\n"));
    open_ = terminal;
  }
  /// Ends a line that is still open.
  void close() {
    if (std::exchange(open_, false)) say("\n");
  }

 private:
  std::chrono::steady_clock::time_point shown_ = std::chrono::steady_clock::now();
  bool open_ = false;
};

/// "1280x720".
std::string read_size(const std::string& text, FilmOptions& options) {
  const char *begin = text.data(), *end = begin + text.size();
  const auto width = std::from_chars(begin, end, options.width_px);
  const bool crossed = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
  const auto height = crossed ? std::from_chars(width.ptr + 1, end, options.height_px) : width;
  const auto good = [](std::uint32_t pixels) { return pixels >= 16 && pixels <= 16384; };
  if (crossed && height.ec == std::errc() && height.ptr == end && good(options.width_px) && good(options.height_px)) return {};
  return "\"" + text + "\" is no size; write WIDTHxHEIGHT in pixels, 16 to 16384 each";
}

int run(int argc, char** argv) {
  FilmOptions options;
  CLI::App app{"Turn a recorded session into a folder of numbered pictures, seen by the cameras of a script.\n"
               "Without --shots: the driver's eyes, once round the driver's car, and the eyes of whoever is nearest then.\n"
               "FILM.md in sim-client/film describes the script; this is one:\n\n"
               "  [[shot]]\n  from_s = 2.0\n  to_s = 6.0\n  participant = \"ambulance\"  # or \"driver\", \"nearest\", an id\n"
               "  distance_m = 9.0           # 0: through their eyes\n  heading_deg = 150.0        # looks back at it\n"
               "  pitch_deg = -12.0\n  [[shot.turn]]              # half of the way round, speeding up\n  heading_deg = 10.0\n"
               "  sigma = 1.0\n",
               "septet film"};
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return fmt::format("septet: {}; septet film --help shows the options\n", error.what());
  });
  app.option_defaults()->always_capture_default();
  app.set_version_flag("--version", version_text());
  app.add_option("session", options.session, "Session file of a drive")->required();
  app.add_option("--shots", options.shots, "Script with the film's shots")->default_str("");
  app.add_option("--out", options.out, "New or empty folder for the pictures")->default_str("film, beside the session");
  app.add_option("--fps", options.frames_per_second, "Frames a second")->check(number_between(1.0, 1000.0))->capture_default_str();
  app.add_option("--size", "Of a picture, in pixels")->type_name("WIDTHxHEIGHT")->default_str("1280x720")->each([&](const std::string& text) {
    if (const auto problem = read_size(text, options); !problem.empty()) throw CLI::ValidationError(problem);
  });
  app.add_flag("--software", options.software, "Draw without a graphics card, pixel for pixel as off-screen screens do");
  app.add_option("--from", options.from_s, "Simulated second: leave out what is earlier")->check(number_between(0.0, 1e6));
  app.add_option("--to", options.to_s, "Simulated second: leave out what is later")->check(number_between(0.0, 1e6));
  if (const auto status = wrong_use(app, argc, argv)) return *status;
  if (options.out.empty()) options.out = options.session.parent_path() / "film";
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGHUP, on_signal);
  ProgressLine progress;
  const auto made = make_film(options, [&](const FilmMade& so_far) {
    progress.show(so_far);
    return !stop_requested;
  });
  progress.close();
  if (!made) {
    say(fmt::format("septet: {}\n", describe(made.error())));
    return 1;
  }
  if (made->frames < made->planned) {
    say(fmt::format("septet: stopped; the first {} of {} pictures are in {}\n", made->frames, made->planned, options.out.string()));
    return 1;
  }
  const std::string pictures = (options.out / "%06d.png").string();
  std::fputs(fmt::format("{}: {} pictures, {} a second; to see them move: ffmpeg -framerate {} -i {} -pix_fmt yuv420p film.mp4\n",
                         options.out.string(), made->frames, options.frames_per_second, options.frames_per_second, pictures).c_str(),
             stdout);
  return 0;
}

}  // namespace
}  // namespace septet::film

int main(int argc, char** argv) {
  try {
    return septet::film::run(argc, argv);
  } catch (const std::exception& error) {
    septet::film::say(std::string("septet: ") + error.what() + "\n");
    return 1;
  }
}
