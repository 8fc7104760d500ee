#include "sim-client/film/film_arguments.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <system_error>

#include <fmt/core.h>

#include "program/command_line.hpp"
#include "sim-client/film/film_program.hpp"
#include "sim-client/film/ghosts.hpp"
#include "sim-client/film/traced/layers.hpp"

namespace septet::film {
namespace {

constexpr std::uint32_t most_samples_for_an_error = 8192;
constexpr std::uint32_t most_photons = 20'000'000;

}  // namespace

FilmRenderer renderer_named(const std::string& name) {
  return name == "traced" ? FilmRenderer::traced : FilmRenderer::raster;
}

void add_film_options(CLI::App& app, FilmArguments& arguments) {
  FilmOptions& options = arguments.film;
  app.add_option("session", options.session, "Session file of a drive");
  app.add_option("--shots", options.shots, "Script with the film's shots")->default_str("");
  app.add_option("--ghost", options.ghosts,
                 "Another session of the same roads, such as one of what-if: who went another way in it is shown too;\n"
                 "several times for several")
      ->type_name("SESSION")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->default_str("");
  app.add_option(
         "--out", options.out,
         "New or empty folder for the pictures, or a film: .mp4 (H.264), .mkv (FFV1, without loss); ffmpeg makes it")
      ->default_str("film, beside the session");
  app.add_option("--fps", options.frames_per_second, "Frames a second")
      ->check(program::number_between(1.0, 1000.0))
      ->capture_default_str();
  app.add_option("--size", "Of a picture, in pixels")
      ->type_name("WIDTHxHEIGHT")
      ->default_str("1280x720")
      ->each([&options](const std::string& text) {
        if (const auto problem = read_size(text, options); !problem.empty()) throw CLI::ValidationError(problem);
      });
  app.add_option("--renderer", arguments.renderer, "raster, or traced: light follows paths, on all cores; slow")
      ->check(CLI::IsMember({"raster", "traced"}))
      ->capture_default_str();
  app.add_option(
         "--samples", options.samples,
         "Of a pixel that is traced: four times as many halve the noise. With --error the most of them: 8192 then")
      ->check(CLI::Range(1u, 1u << 20))
      ->capture_default_str();
  app.add_option("--within", arguments.within_s,
                 "Time for what is traced, such as 10min: as many samples as there is time for, found by trying some\n"
                 "frames; the noise is taken out where they are few. With --samples the most of them")
      ->transform(CLI::AsNumberWithUnit(std::map<std::string, double>{{"s", 1.0}, {"min", 60.0}, {"h", 3600.0}}))
      ->check(program::number_between(1.0, 1e8))
      ->type_name("TIME")
      ->default_str("none");
  app.add_option("--error", options.error,
                 "Enough of it, such as 0.02, as a share of a pixel's light: where it is had no more samples are taken")
      ->check(program::number_between(1e-4, 1.0))
      ->default_str("none");
  app.add_option("--filter", arguments.filter,
                 "How the light around a pixel's middle is weighed: a B-spline, 1 to 4 pixels across")
      ->check(CLI::IsMember({"box", "tent", "quadratic", "cubic"}))
      ->capture_default_str();
  app.add_option("--caustic-photons", options.caustic_photons,
                 "Sent at ice that is seen, of what is traced: the light that it throws on what lies around. 0: none")
      ->check(CLI::Range(0u, most_photons))
      ->capture_default_str();
  app.add_option("--gather-photons", options.gather_photons,
                 "Sent by lamps where they alone shine, without sky or fog: a path then ends at the second matt "
                 "surface, with the\n"
                 "light that photons have brought there. 0: paths go on")
      ->check(CLI::Range(0u, most_photons))
      ->capture_default_str();
  app.add_flag("--denoise", options.denoise, "Take the noise out of what is traced, guided by normals and colours")
      ->default_str("");
  app.add_option("--exr", arguments.exr,
                 "OpenEXR pictures too, of what is traced: half (16 bits a number) or float (32)")
      ->check(CLI::IsMember({"none", "half", "float"}))
      ->capture_default_str();
  app.add_option("--layers",
                 "What they hold beside light: all, or some of depth,object,participant,normal,albedo,motion,variance")
      ->type_name("NAMES")
      ->default_str("")
      ->each([&options](const std::string& text) {
        if (const auto problem = read_layers(text, options.layers); !problem.empty())
          throw CLI::ValidationError(problem);
      });
  app.add_flag_callback(
      "--no-sound", [&options] { options.sound = false; }, "Leave out what the driver heard");
  app.add_flag("--resume", options.resume, "Go on with a film that was stopped: what is drawn is not drawn again");
  app.add_flag("--software", options.software,
               "Draw without a graphics card, pixel for pixel as off-screen screens do");
  app.add_option("--every", options.every,
                 "Draw only the first frame, the one after so many, and so on: a film to look over")
      ->check(CLI::Range(1u, 1'000'000u))
      ->capture_default_str();
  app.add_option("--from", options.from_s, "Simulated second: leave out what is earlier")
      ->check(program::number_between(0.0, 1e6));
  app.add_option("--to", options.to_s, "Simulated second: leave out what is later")
      ->check(program::number_between(0.0, 1e6));
  app.add_option("--schedule", arguments.schedule,
                 "How tiles are dealt to programs: by speed, splitting what is late; or in equal buckets, to whoever "
                 "is free, as a\n"
                 "paper has it, or in turn. The pictures are the same")
      ->check(CLI::IsMember({"ours", "paper", "round-robin"}))
      ->capture_default_str();
  app.add_option("--buckets", options.schedule.equal_buckets, "Of a frame, where they are equal")
      ->check(CLI::Range(1u, 1u << 20))
      ->capture_default_str();
  app.add_option("--sample-sets", options.sample_sets,
                 "Deal each tile's samples in so many sets too: buckets of samples, as a paper has them")
      ->check(CLI::Range(1u, 4096u))
      ->capture_default_str();
  app.add_option("--statistics", options.statistics, "JSON file that tells who traced what, when and at what cost")
      ->default_str("");
  app.add_option("--ranks", arguments.ranks.ranks,
                 "Programs that trace, started by Open MPI; one that dies is done without")
      ->check(CLI::Range(1u, 4096u))
      ->default_str("one for each host");
  app.add_option("--hosts", arguments.ranks.hosts,
                 "File with the machines that trace, one a line; changed meanwhile, the film goes on with those")
      ->default_str("this machine");
  app.add_flag("--one-of-ranks", arguments.one_of_ranks)->group("");  // Set by film_by_ranks alone.
}

Expected<void> settle(const CLI::App& app, FilmArguments& arguments) {
  FilmOptions& options = arguments.film;
  if (options.session.empty())
    return failure("it is not said which session", "septet film", "give the session file of a drive");
  if (options.ghosts.size() > most_ghost_sessions)
    return failure(fmt::format("{} sessions are given, and a film has numbers for the participants of {} as ghosts",
                               options.ghosts.size(), most_ghost_sessions),
                   "--ghost", fmt::format("give {} at most", most_ghost_sessions));
  options.renderer = renderer_named(arguments.renderer);
  options.filter = arguments.filter == "box"         ? raytrace::Filter::box
                   : arguments.filter == "tent"      ? raytrace::Filter::tent
                   : arguments.filter == "quadratic" ? raytrace::Filter::quadratic
                                                     : raytrace::Filter::cubic;
  if ((options.error > 0.0 || arguments.within_s > 0.0) && app["--samples"]->empty())
    options.samples = most_samples_for_an_error;
  options.exr = arguments.exr == "half"    ? ExrNumbers::half_precision
                : arguments.exr == "float" ? ExrNumbers::single_precision
                                           : ExrNumbers::none;
  options.schedule.dealing = arguments.schedule == "paper"         ? raytrace::Dealing::equal
                             : arguments.schedule == "round-robin" ? raytrace::Dealing::round_robin
                                                                   : raytrace::Dealing::split;
  if (options.out.empty()) options.out = options.session.parent_path() / "film";
  arguments.by_ranks = !arguments.one_of_ranks && !(app["--ranks"]->empty() && app["--hosts"]->empty());
  const bool traced = options.renderer == FilmRenderer::traced;
  if (arguments.by_ranks && !traced)
    return failure("several programs share out what is traced alone", "--ranks, --hosts", "add --renderer traced");
  if (options.sample_sets > 1 && (options.error > 0.0 || arguments.within_s > 0.0))
    return failure("samples are dealt in sets where it is known how many there are", "--sample-sets",
                   "leave out --error and --within");
  if (options.sample_sets > options.samples)
    return failure("there are more sets than samples", "--sample-sets", "choose at most as many as --samples");
  std::error_code ignored;
  if (const auto folder = options.statistics.parent_path();
      !folder.empty() && !std::filesystem::is_directory(folder, ignored))
    return failure("there is no such folder", folder.string(), "make it, or choose another file with --statistics");
  if (arguments.within_s > 0.0 && !traced)
    return failure("only what is traced takes the time that it is given", "--within", "add --renderer traced");
  arguments.ranks.out = options.out, arguments.ranks.resume = options.resume;
  return {};
}

}  // namespace septet::film
