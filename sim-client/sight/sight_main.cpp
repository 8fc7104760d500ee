/// `septet-sight`: who was unobstructed for whom in a recorded session. `septet sight` starts it.

#include <filesystem>
#include <string>

#include <fmt/core.h>

#include "engine/core/version.hpp"
#include "program/command_line.hpp"
#include "program/confinement.hpp"
#include "sim-client/sight/sight_program.hpp"

int main(int argc, char** argv) {
  using namespace septet;
  using program::number_between;
  sight::SightOptions options;
  CLI::App app{
      "Tell who was unobstructed for whom in a recorded session, and since when (docs/sight.md): the share of each\n"
      "silhouette past pillars, vehicles, walls and trees, through glass, smoke and fog, straight and in mirrors.",
      "septet sight"};
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return fmt::format("septet: {}; septet sight --help shows the options\n", error.what());
  });
  app.option_defaults()->always_capture_default();
  app.set_version_flag("--version", version_text());
  app.add_option("session", options.session, "Session file of a drive")->required();
  app.add_option("--out", options.out, "Folder for sight.csv, sight.svg and sight.txt")
      ->default_str("sight, beside the session");
  app.add_option("--eyes", options.eyes,
                 "Whose eyes: a name or number of septet session participants, or driver; the other way is told too")
      ->type_name("NAME")
      ->default_str("the driver's");
  app.add_option("--target", options.target, "Whom they look at: a name or number")
      ->type_name("NAME")
      ->default_str("everybody within range");
  app.add_option("--range", options.range_m, "Metres within which others come at some time to be told of")
      ->check(number_between(1.0, 10000.0))
      ->capture_default_str();
  app.add_option("--pairs", options.pairs, "Most pairs; those that touch first, then the nearest")
      ->check(CLI::Range(1u, 1000u))
      ->capture_default_str();
  app.add_option("--from", options.from_s, "Simulated second: leave out what is earlier")
      ->check(number_between(0.0, 1e6));
  app.add_option("--to", options.to_s, "Simulated second: leave out what is later")->check(number_between(0.0, 1e6));
  app.add_option("--every", options.every_s, "Seconds from sample to sample; changes between are found to the tick")
      ->check(number_between(0.001, 60.0))
      ->capture_default_str();
  app.add_option("--least", options.threshold.light,
                 "Share of a silhouette's light from which it counts as unobstructed")
      ->check(number_between(0.0, 1.0))
      ->capture_default_str();
  app.add_flag_callback(
      "--no-mirrors", [&options] { options.mirrors = false; }, "Leave mirrors out");
  return program::run("septet", app, argc, argv, [&] {
    const auto out = options.out.empty() ? options.session.parent_path() / "sight" : options.out;
    program::write_only_below({std::filesystem::absolute(out)});
    return sight::run_sight(options);
  });
}
