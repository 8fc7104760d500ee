/// `septet-film`: a recorded session to the pictures of a film. `septet film` starts it.

#include <cstdint>
#include <string>

#include <fmt/core.h>

#include "engine/core/version.hpp"
#include "program/command_line.hpp"
#include "program/console.hpp"
#include "sim-client/film/film_program.hpp"
#include "sim-client/film/traced/layers.hpp"
#include "sim-client/film/traced/ranks.hpp"

namespace {
constexpr std::uint32_t most_samples_for_an_error = 8192;
}

int main(int argc, char** argv) {
  using namespace septet;
  using program::number_between;
  film::FilmOptions options;
  film::RanksOptions ranks;
  bool one_of_ranks = false;
  std::string renderer = "raster", exr = "none", filter = "quadratic";
  CLI::App app{
      "Turn a recorded session into a folder of numbered pictures, or a film, seen by the cameras of a script.\n"
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
  app.add_option(
         "--out", options.out,
         "New or empty folder for the pictures, or a film: .mp4 (H.264), .mkv (FFV1, without loss); ffmpeg makes it")
      ->default_str("film, beside the session");
  app.add_option("--fps", options.frames_per_second, "Frames a second")
      ->check(number_between(1.0, 1000.0))
      ->capture_default_str();
  app.add_option("--size", "Of a picture, in pixels")
      ->type_name("WIDTHxHEIGHT")
      ->default_str("1280x720")
      ->each([&](const std::string& text) {
        if (const auto problem = film::read_size(text, options); !problem.empty()) throw CLI::ValidationError(problem);
      });
  app.add_option("--renderer", renderer,
                 "raster, or traced: light follows paths, on all cores; slow; no smoke, flames, clouds or stars yet")
      ->check(CLI::IsMember({"raster", "traced"}))
      ->capture_default_str();
  app.add_option(
         "--samples", options.samples,
         "Of a pixel that is traced: four times as many halve the noise. With --error the most of them: 8192 then")
      ->check(CLI::Range(1u, 1u << 20))
      ->capture_default_str();
  app.add_option("--error", options.error,
                 "Enough of it, such as 0.02, as a share of a pixel's light: where it is had no more samples are taken")
      ->check(number_between(1e-4, 1.0))
      ->default_str("none");
  app.add_option("--filter", filter,
                 "How the light around a pixel's middle is weighed: a B-spline, 1 to 4 pixels across")
      ->check(CLI::IsMember({"box", "tent", "quadratic", "cubic"}))
      ->capture_default_str();
  app.add_flag("--denoise", options.denoise, "Take the noise out of what is traced, guided by normals and colours")
      ->default_str("");
  app.add_option("--exr", exr, "OpenEXR pictures too, of what is traced: half (16 bits a number) or float (32)")
      ->check(CLI::IsMember({"none", "half", "float"}))
      ->capture_default_str();
  app.add_option("--layers",
                 "What they hold beside light: all, or some of depth,object,participant,normal,albedo,motion,variance")
      ->type_name("NAMES")
      ->default_str("")
      ->each([&](const std::string& text) {
        if (const auto problem = film::read_layers(text, options.layers); !problem.empty())
          throw CLI::ValidationError(problem);
      });
  app.add_flag("--resume", options.resume, "Go on with a film that was stopped: what is drawn is not drawn again");
  app.add_flag("--software", options.software,
               "Draw without a graphics card, pixel for pixel as off-screen screens do");
  app.add_option("--from", options.from_s, "Simulated second: leave out what is earlier")
      ->check(number_between(0.0, 1e6));
  app.add_option("--to", options.to_s, "Simulated second: leave out what is later")->check(number_between(0.0, 1e6));
  std::string schedule = "ours";
  app.add_option("--schedule", schedule,
                 "How tiles are dealt to programs: by speed, splitting what is late; or in equal buckets, to whoever "
                 "is free, as a\n"
                 "paper has it, or in turn. The pictures are the same")
      ->check(CLI::IsMember({"ours", "paper", "round-robin"}))
      ->capture_default_str();
  app.add_option("--buckets", options.schedule.equal_buckets, "Of a frame, where they are equal")
      ->check(CLI::Range(1u, 1u << 20))
      ->capture_default_str();
  app.add_option("--statistics", options.statistics, "JSON file that tells who traced what, when and at what cost")
      ->default_str("");
  CLI::Option* const ranks_option =
      app.add_option("--ranks", ranks.ranks, "Programs that trace, started by Open MPI; one that dies is done without")
          ->check(CLI::Range(1u, 4096u))
          ->default_str("one for each host");
  CLI::Option* const hosts_option =
      app.add_option("--hosts", ranks.hosts,
                     "File with the machines that trace, one a line; changed meanwhile, the film goes on with those")
          ->default_str("this machine");
  app.add_flag("--one-of-ranks", one_of_ranks)->group("");  // Said by film_by_ranks alone.
  return film::run_alone_or_by_mpirun([&](film::Machines* others) {
    const int status = program::run("septet", app, argc, argv, [&]() -> Expected<int> {
      options.renderer = renderer == "traced" ? film::FilmRenderer::traced : film::FilmRenderer::raster;
      options.filter = filter == "box"         ? raytrace::Filter::box
                       : filter == "tent"      ? raytrace::Filter::tent
                       : filter == "quadratic" ? raytrace::Filter::quadratic
                                               : raytrace::Filter::cubic;
      if (options.error > 0.0 && app["--samples"]->empty()) options.samples = most_samples_for_an_error;
      options.exr = exr == "half"    ? film::ExrNumbers::half_precision
                    : exr == "float" ? film::ExrNumbers::single_precision
                                     : film::ExrNumbers::none;
      options.schedule.dealing = schedule == "paper"         ? raytrace::Dealing::equal
                                 : schedule == "round-robin" ? raytrace::Dealing::round_robin
                                                             : raytrace::Dealing::split;
      if (options.out.empty()) options.out = options.session.parent_path() / "film";
      if (one_of_ranks || (ranks_option->empty() && hosts_option->empty())) return film::run_film(options, others);
      if (others)
        return failure("mpirun has started these programs, and they are to start it", "--ranks, --hosts",
                       "leave mpirun or these options out");
      if (options.renderer != film::FilmRenderer::traced)
        return failure("several programs share out what is traced alone", "--ranks, --hosts", "add --renderer traced");
      ranks.out = options.out, ranks.resume = options.resume;
      return film::film_by_ranks(ranks, {argv + 1, argv + argc});
    });
    if (one_of_ranks) program::announce(film::last_words + std::to_string(status));
    return status;
  });
}
