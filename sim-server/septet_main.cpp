/// `septet`: the command people type.

#include <functional>
#include <iostream>

#include <fmt/core.h>

#include "car-io/driving_keys.hpp"
#include "engine/core/version.hpp"
#include "program/command_line.hpp"
#include "program/console.hpp"
#include "sim-server/command/check_command.hpp"
#include "sim-server/command/drive_command.hpp"
#include "sim-server/command/film_command.hpp"
#include "sim-server/command/list_command.hpp"
#include "sim-server/command/replay_command.hpp"
#include "sim-server/command/report_command.hpp"
#include "sim-server/command/rig_command.hpp"
#include "sim-server/command/road_command.hpp"
#include "sim-server/command/traffic_command.hpp"
#include "sim-server/command/vehicle_command.hpp"

namespace septet::server {
namespace {

using program::number_between, program::seed_number;

/// Options that `drive` and `replay` share, and what they are by default.
void add_drive_options(CLI::App& command, DriveOptions& options, const std::string& out, const std::string& seconds) {
  command.add_option("--rig", options.rig, "Rig: a file or a name of septet list rigs")->default_str("desktop with a display, else seven-screens");
  command.add_option("--out", options.out, "Folder for pictures, log and report; what an earlier one left there is moved aside")->default_str(out);
  command.add_option("--seconds", options.seconds, "Simulated seconds to run; 0: until its own end, or until somebody stops it")->default_str(seconds)->check(number_between(0.0, 1e6));
  command.add_flag("--full-screen", options.full_screen, "Cover whole monitors: those that the rig names, else the first");
  command.add_flag("--virtual", options.virtual_screens, "Off-screen pictures in lockstep, even where there is a display");
}

int run(int argc, char** argv) {
  CLI::App app{"Septet: a driving simulator that surrounds a real car with seven screens."};
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  app.footer("Exit status: 0 finished, 1 failed, 2 wrong use, 3 a drive or replay that somebody stopped before its end.");
  app.failure_message([](const CLI::App* self, const CLI::Error& error) {
    return fmt::format("septet: {}; {} --help shows the options\n", error.what(), self->get_display_name());
  });
  std::function<Expected<int>()> work;

  app.option_defaults()->always_capture_default();
  DriveOptions drive;
  auto* drive_command = app.add_subcommand("drive", "Drive a scenario: server, screens and car on this machine");
  add_drive_options(*drive_command, drive, "out/latest", "0 in a window, 30 off-screen");
  drive_command->add_option("--scenario", drive.scenario, "OpenSCENARIO file, its folder, or a name of septet list scenarios");
  drive_command->add_option("--parameter", drive.parameters, "Of the scenario, instead of its own value; as often as needed")->type_name("NAME=VALUE")->default_str("")->allow_extra_args(false);
  drive_command->add_option("--vehicle", drive.vehicle, "Vehicle file, or a name of septet list vehicles")->default_str("the rig's");
  drive_command->add_option("--participant", drive.participant, "The driver's code, for log, summary and report")->default_str("none");
  drive_command->add_option("--seed", drive.seed, "Seed of everything random")->check(seed_number());
  drive_command->add_option("--driver", drive.driver, "A simulated driver of septet list drivers drives")->default_str("whom the rig names");
  drive_command->add_flag("--start-now", drive.start_now, "Do not wait until the driver presses a key or a pedal");
  drive_command->add_option("--traffic", drive.traffic, "Who moves the traffic: own, or sumo where the package sumo is installed");
  drive_command->add_flag("--no-screens", drive.no_screens, "Server and car only, as fast as it goes");
  drive_command->footer(car_io::driving_keys_text());
  drive_command->callback([&] { work = [&] { return run_drive(drive); }; });

  DriveOptions replay;
  bool verify = false;
  auto* replay_command = app.add_subcommand("replay", "Show a session again on any rig, or verify that its input gives the same drive");
  replay_command->add_option("session", replay.replay, "Session file")->required();
  add_drive_options(*replay_command, replay, "replay, beside the session", "0");
  replay_command->add_option("--from", replay.replay_from_s, "Simulated second to begin at")->check(number_between(0.0, 1e6));
  replay_command->add_flag("--verify", verify, "Run the recorded input again and compare every tick's state hash");
  replay_command->callback([&] { work = [&] { return verify ? run_verify(replay.replay) : run_drive(replay); }; });

  // Its options are those of septet-film, which explains them too.
  auto* film_command = app.add_subcommand("film", "Make the pictures of a film from a session: through anybody's eyes, or from around them");
  film_command->prefix_command();
  film_command->set_help_flag();
  film_command->callback([&] { work = [&] { return run_film({argv + 2, argv + argc}); }; });

  std::string session;
  std::filesystem::path report_out;
  auto* report_command = app.add_subcommand("report", "Write report.html for a session");
  report_command->add_option("session", session, "Session file")->required();
  report_command->add_option("--out", report_out, "Where to write")->default_str("report.html beside the session");
  report_command->callback([&] { work = [&] { return run_report(session, report_out); }; });

  auto* road_command = app.add_subcommand("road", "Questions to a road file");
  road_command->require_subcommand(1);
  std::string road_file;
  auto* sample = road_command->add_subcommand("sample", "Lines road_id,lane_id,s_m,lane_offset_m in, poses out");
  sample->add_option("file", road_file, "OpenDRIVE file")->required();
  sample->callback([&] { work = [&] { return run_road_sample(road_file, std::cin, std::cout); }; });
  auto* locate = road_command->add_subcommand("locate", "Lines x_m,y_m in, road positions out");
  locate->add_option("file", road_file, "OpenDRIVE file")->required();
  locate->callback([&] { work = [&] { return run_road_locate(road_file, std::cin, std::cout); }; });

  auto* rig_command = app.add_subcommand("rig", "What a rig of several machines needs");
  rig_command->require_subcommand(1);
  std::string rig_name;
  std::filesystem::path keys_out = "keys";
  auto* rig_keys = rig_command->add_subcommand("keys", "Make the keys of a rig's machines, one folder for each (rigs/EIGHT-PCS.md)");
  rig_keys->add_option("rig", rig_name, "Rig: a file or a name")->required();
  rig_keys->add_option("--out", keys_out, "Folder for the folders; keys that are there stay")->capture_default_str();
  rig_keys->callback([&] { work = [&] { return run_rig_keys(rig_name, keys_out); }; });

  auto* vehicle_command = app.add_subcommand("vehicle", "A car on the test track");
  vehicle_command->require_subcommand(1);
  VehicleTestOptions track;
  auto* vehicle_test = vehicle_command->add_subcommand("test", "Run a standard manoeuvre: figures, time series and a plot");
  auto* manoeuvre = vehicle_test->add_option("--manoeuvre", track.manoeuvre, "steady-circle, step-steer, double-lane-change, sine-with-dwell, stop, coast-down, acceleration or all");
  vehicle_test->add_option("--vehicle", track.vehicle, "Vehicle file, or a name of septet list vehicles");
  vehicle_test->add_option("--out", track.out, "Folder for the files; without it the figures are only printed");
  auto* inputs = vehicle_test->add_option("--inputs", track.inputs, "Drive these inputs instead: CSV with time_s and any of steering_wheel_deg, accelerator, brake, clutch, gear, parking_brake");
  inputs->excludes(manoeuvre);
  double track_speed_kmh = 0.0;
  vehicle_test->add_option("--speed", track_speed_kmh, "km/h")->default_str("the manoeuvre's")->check(number_between(0.0, 400.0));
  vehicle_test->add_option("--friction", track.conditions.friction, "Of the road")->default_str("that for which the tyre is given")->check(number_between(0.01, 3.0));
  vehicle_test->add_option("--amplitude", track.amplitude_deg, "Degrees of the hand wheel, for step-steer and sine-with-dwell")->default_str("found by the manoeuvre")->check(number_between(-1500.0, 1500.0));
  vehicle_test->add_option("--esc", track.conditions.stability_control, "on or off: the stability control; without it on for sine-with-dwell and --inputs")
      ->transform(CLI::CheckedTransformer(std::map<std::string, bool>{{"on", true}, {"off", false}}));
  vehicle_test->callback([&] {
    if (track.manoeuvre.empty() && track.inputs.empty()) throw CLI::RequiredError("--manoeuvre or --inputs");
    track.conditions.speed_mps = track_speed_kmh / 3.6;
    work = [&] { return run_vehicle_test(track); };
  });

  auto* traffic_command = app.add_subcommand("traffic", "Septet's traffic on the test track");
  traffic_command->require_subcommand(1);
  TrafficDiagramOptions diagram;
  auto* traffic_diagram = traffic_command->add_subcommand("diagram", "The fundamental diagram: figures, a table and a plot");
  traffic_diagram->add_option("--lanes", diagram.lanes, "Of the ring")->check(CLI::Range(1, 8))->capture_default_str();
  traffic_diagram->add_option("--seed", diagram.seed, "Of vehicles and drivers")->check(seed_number())->capture_default_str();
  traffic_diagram->add_option("--out", diagram.out, "Folder for the files; without it the figures are only printed");
  traffic_diagram->callback([&] { work = [&] { return run_traffic_diagram(diagram); }; });

  std::string kind;
  auto* list_command = app.add_subcommand("list", "What there is to choose from, a line each");
  list_command->add_option("kind", kind, "What of")->required()->check(CLI::IsMember(listed_kinds()));
  list_command->callback([&] { work = [&] { return run_list(kind); }; });

  CheckOptions check;
  auto* check_command = app.add_subcommand("check", "Say what is wrong with files; exit status 1: a file has an error");
  check_command->add_option("files", check.files, "Roads (.xodr), scenarios and catalogs (.xosc), rigs, vehicles and film scripts (.toml), sessions (.sqlite)")->required();
  check_command->add_flag("--json", check.json, "Answer in JSON (docs/check.md)");
  check_command->add_flag("--strict", check.strict, "Warnings count as errors in the exit status");
  check_command->callback([&] { work = [&]() -> Expected<int> { return run_check(check, std::cout); }; });

  // The parser's own message does not name the word that it did not know.
  if (const std::string word = argc > 1 ? argv[1] : "-"; !word.starts_with('-')) {
    std::string commands;
    bool known = false;
    for (const CLI::App* command : app.get_subcommands(nullptr)) {
      commands += (commands.empty() ? "" : ", ") + command->get_name();
      known = known || command->get_name() == word;
    }
    if (!known) {
      program::say(fmt::format("septet: there is no command \"{}\"; use one of: {}", word, commands));
      return program::wrong_use_status;
    }
  }
  return program::run("septet", app, argc, argv, [&] { return work(); });
}

}  // namespace
}  // namespace septet::server

int main(int argc, char** argv) { return septet::server::run(argc, argv); }
