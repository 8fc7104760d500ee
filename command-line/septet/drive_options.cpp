#include <filesystem>
#include <vector>

#include "car-io/driving_keys.hpp"
#include "command-line/command/other_program.hpp"
#include "command-line/command/replay_command.hpp"
#include "command-line/septet/options.hpp"
#include "program/command_line.hpp"
#include "program/confinement.hpp"

namespace septet::server {
namespace {

using program::number_between, program::seed_number;

/// Options that `drive` and `replay` share, and their defaults.
void add_drive_options(CLI::App& command, DriveOptions& drive, const std::string& out, const std::string& seconds) {
  command.add_option("--rig", drive.rig, "Rig: a file or a name of septet list rigs")
      ->default_str("desktop with a display, else seven-screens");
  command
      .add_option("--out", drive.out,
                  "Folder for pictures, log and report; what an earlier one left there is moved aside")
      ->default_str(out);
  command
      .add_option("--seconds", drive.seconds,
                  "Simulated seconds to run; 0: until its own end, or until somebody stops it")
      ->default_str(seconds)
      ->check(number_between(0.0, 1e6));
  command.add_flag("--full-screen", drive.full_screen,
                   "Cover whole monitors: those that the rig names, else the first");
  command.add_flag("--no-sound", drive.no_sound, "Silent, also where the rig has a sound");
  command.add_flag("--virtual", drive.virtual_screens,
                   "Off-screen pictures in lockstep, even where there is a display");
}

void add_models_option(CLI::App& command, std::filesystem::path& models) {
  command.add_option("--models", models, "Folder of your own glTF models: NAME.glb replaces NAME")->default_str("none");
}

}  // namespace

void add_drive_commands(CLI::App& app, Options& options) {
  auto* drive_command = app.add_subcommand("drive", "Drive a scenario: server, screens and car on this machine");
  add_drive_options(*drive_command, options.drive, "out/latest", "0 in a window, 30 off-screen");
  drive_command->add_option(
      "--scenario", options.drive.scenario,
      "OpenSCENARIO file, its folder, a name of septet list scenarios, or a road by itself (docs/your-town.md)");
  drive_command
      ->add_option("--parameter", options.drive.parameters,
                   "Of the scenario, instead of its own value; as often as needed")
      ->type_name("NAME=VALUE")
      ->default_str("")
      ->allow_extra_args(false);
  drive_command->add_option("--vehicle", options.drive.vehicle, "Vehicle file, or a name of septet list vehicles")
      ->default_str("the rig's");
  drive_command->add_option("--edits", options.drive.edits, "File of edits over the generated world (docs/editing.md)")
      ->default_str("none");
  drive_command
      ->add_option("--save", options.drive.save,
                   "At the end, write what differs from the generated world to this file of edits")
      ->default_str("nothing is written");
  auto* editors =
      drive_command
          ->add_option(
              "--editors", options.drive.editors,
              "Folder for the key and address by which septet edit, and scripts, change the world while it is driven")
          ->default_str("none: nobody edits");
  add_models_option(*drive_command, options.drive.models);
  drive_command
      ->add_option("--participant", options.drive.participant, "The driver's code, for log, summary and report")
      ->default_str("none");
  const auto add_about = [&](const std::string& option, const std::string& key, const std::string& what) {
    drive_command
        ->add_option_function<std::string>(
            option, [&options, key](const std::string& value) { options.drive.about.push_back(key + '=' + value); },
            what)
        ->type_name("TEXT")
        ->default_str("");
  };
  add_about("--group", "group", "The driver's group, for log and pooled reports");
  add_about("--condition", "condition", "The condition of this drive, likewise");
  add_about("--order", "order", "Which of the driver's drives it is, likewise");
  add_about("--part", "part", "Which part of an experiment it is, likewise");
  add_about("--note", "note", "The experimenter's note");
  drive_command
      ->add_option_function<std::vector<std::string>>(
          "--column",
          [&options](const std::vector<std::string>& columns) {
            for (const auto& column : columns) options.drive.about.push_back("column." + column);
          },
          "Anything else of the driver, for columns of pooled reports; as often as needed")
      ->type_name("NAME=VALUE")
      ->default_str("")
      ->allow_extra_args(false);
  drive_command->add_option("--log", options.drive.log, "whole, or samples: without what a replay needs")
      ->check(CLI::IsMember({"whole", "samples"}));
  drive_command->add_option("--seed", options.drive.seed, "Seed of everything random")->check(seed_number());
  auto* driver =
      drive_command->add_option("--driver", options.drive.driver, "A simulated driver of septet list drivers drives")
          ->default_str("the rig's");
  drive_command
      ->add_option("--to", options.drive.to,
                   "Guide the driver to a place: a road's name or id, id:s in metres, or x,y (docs/guidance.md)")
      ->type_name("PLACE")
      ->default_str("nobody guides");
  drive_command->add_option("--language", options.drive.language, "Of spoken guidance")
      ->check(CLI::IsMember({"en", "de", "sv"}));
  drive_command
      ->add_option("--motion", options.drive.motion,
                   "Nobody drives: the car goes by a table, a path or an event data recorder's (docs/given-motion.md)")
      ->type_name("FILE")
      ->default_str("none")
      ->excludes(driver);
  drive_command->add_flag("--start-now", options.drive.start_now,
                          "Do not wait until the driver presses a key or a pedal");
  drive_command->add_option("--traffic", options.drive.traffic,
                            "Engine of the traffic: own, or sumo if the package sumo is installed");
  drive_command
      ->add_option("--page", options.drive.page_port, "Port of the operator's page on 127.0.0.1; 0: any free one")
      ->default_str("no page")
      ->check(CLI::Range(0, 65535));
  drive_command
      ->add_option("--page-host", options.drive.page_hosts,
                   "Name by which a proxy in front of the page is asked for; as often as needed")
      ->type_name("NAME")
      ->default_str("")
      ->allow_extra_args(false);
  drive_command->add_flag("--no-screens", options.drive.no_screens, "Server and car only, as fast as it goes")
      ->excludes(editors);
  drive_command->footer(car_io::driving_keys_text());
  drive_command->callback([&] { options.work = [&] { return run_drive(options.drive); }; });

  auto* operate_command = app.add_subcommand(
      "operate", "The operator's page: choose drives and start them, look on, see past ones, until this is stopped");
  operate_command->add_option("--page", options.operate.port, "Its port on 127.0.0.1; 0: any free one")
      ->check(CLI::Range(0, 65535));
  operate_command
      ->add_option("--page-host", options.operate.page_hosts,
                   "Name by which a proxy in front of the page is asked for; as often as needed")
      ->type_name("NAME")
      ->default_str("")
      ->allow_extra_args(false);
  operate_command->add_option("--out", options.operate.out, "Folder in which each drive gets one of its own")
      ->default_str("out/drives");
  operate_command
      ->add_option("--keys", options.operate.keys,
                   "Of a rig of several machines: the server's folder of septet rig keys; its screens run already")
      ->default_str("none: screens and car of this machine");
  add_data_option(*operate_command, options.operate.data);
  operate_command
      ->add_option("--rig", options.operate.rig,
                   "The rig that stands here: chosen unless the page chooses another; what lies beside its file can be "
                   "chosen too")
      ->default_str("desktop, or off-screen without a display");
  add_models_option(*operate_command, options.operate.models);
  operate_command->callback([&] { options.work = [&] { return run_operate(options.operate); }; });

  auto* replay_command =
      app.add_subcommand("replay", "Show a session again on any rig, or verify that its input gives the same drive");
  replay_command->add_option("session", options.replay.replay, "Session file")->required();
  add_drive_options(*replay_command, options.replay, "replay, beside the session", "0");
  replay_command
      ->add_option("--from", options.replay.replay_from_s,
                   "Simulated second to begin at; with --verify at the last state before it that the log keeps")
      ->check(number_between(0.0, 1e6));
  auto* eyes = replay_command
                   ->add_option("--eyes", options.replay.eyes,
                                "Somebody at whose eyes the screens stand: a name or number of septet session "
                                "participants; driver: head and gaze as logged")
                   ->type_name("NAME")
                   ->default_str("the driver's");
  replay_command
      ->add_flag("--verify", options.verify, "Run the recorded input again and compare every tick's state hash")
      ->excludes(eyes);
  replay_command->callback([&] {
    options.work = [&] {
      if (!options.verify) return run_drive(options.replay);
      program::write_only_below({});
      return run_verify(options.replay.replay, options.replay.replay_from_s);
    };
  });

  // The options of these five are those of the programs that they start, which explain them too.
  auto* film_command = app.add_subcommand(
      "film", "Make the pictures of a film from a session: through anybody's eyes, or from around them");
  film_command->prefix_command();
  film_command->set_help_flag();
  film_command->callback([&] { options.work = [&] { return become("septet-film", options.passed_on); }; });

  auto* accident_command = app.add_subcommand(
      "accident", "Plan the film of a contact from the log, make it with stills and a page, or check one");
  accident_command->prefix_command();
  accident_command->set_help_flag();
  accident_command->callback([&] {
    options.work = [&] {
      std::vector<std::string> words{"accident"};
      words.insert(words.end(), options.passed_on.begin(), options.passed_on.end());
      return become("septet-film", std::move(words));
    };
  });

  auto* sound_command =
      app.add_subcommand("sound", "Make the sound of a session: what the driver heard, as a WAV file");
  sound_command->prefix_command();
  sound_command->set_help_flag();
  sound_command->callback([&] { options.work = [&] { return become("septet-sound", options.passed_on); }; });

  auto* sight_command = app.add_subcommand(
      "sight", "Tell who was unobstructed for whom in a session, and since when: sentences, a table, a chart");
  sight_command->prefix_command();
  sight_command->set_help_flag();
  sight_command->callback([&] { options.work = [&] { return become("septet-sight", options.passed_on); }; });

  auto* ice_command = app.add_subcommand("ice", "Draw an object of ice alone, turning, each part of it on or off");
  ice_command->prefix_command();
  ice_command->set_help_flag();
  ice_command->callback([&] { options.work = [&] { return become("septet-ice", options.passed_on); }; });

  auto* car_command = app.add_subcommand(
      "car", "Calibrate the car or learn a joystick, try actuators, serve a game: what the car's own program does");
  car_command->prefix_command();
  car_command->set_help_flag();
  car_command->callback([&] { options.work = [&] { return become("septet-car", options.passed_on); }; });

  auto* report_command = app.add_subcommand(
      "report", "Write report.html for a session, or pool many: a page for the group, subjects.csv and subjects.json");
  report_command->add_option("sessions", options.report.places, "Session files, or folders with sessions below")
      ->required();
  report_command->add_option("--out", options.report.out, "Where to write: of one session a file, of many a folder")
      ->default_str("report.html beside the session; group-report");
  report_command->add_option("--title", options.report.title, "Of a pooled report")->default_str("A group of drives");
  report_command
      ->add_option("--brake-event", options.report.brake_event,
                   "Measure brake reactions from these events of the log: KIND, or KIND:PART OF THE DETAIL")
      ->default_str("none");
  report_command->callback([&] {
    options.work = [&] {
      auto places = options.report.places;  // Without --out it writes beside its input.
      places.emplace_back(".");
      program::write_only_below(options.report.out.empty() ? places : std::vector{options.report.out});
      return run_report(options.report);
    };
  });
}

}  // namespace septet::server
