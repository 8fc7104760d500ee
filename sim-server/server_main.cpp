/// `septet-server`: the simulation of one drive, for the screens of a rig.

#include <cstdlib>

#include "engine/core/version.hpp"
#include "program/command_line.hpp"
#include "sim-server/server_program.hpp"

int main(int argc, char** argv) {
  using namespace septet;
  using program::number_between, program::seed_number;
  server::ServerOptions options;
  options.scenario = "motorway-ambulance";
  options.rig = "seven-screens";
  options.out = "out/server";
  CLI::App app{
      "septet-server: the simulation of one drive. `septet drive` starts it; on a rig of several machines start it "
      "yourself."};
  app.option_defaults()->always_capture_default();
  app.set_version_flag("--version", version_text());
  app.add_option("--scenario", options.scenario, "OpenSCENARIO file, its folder, or a name below scenarios/");
  app.add_option("--rig", options.rig, "Rig file or name");
  app.add_option("--out", options.out, "Folder for the session file and the results");
  app.add_option("--keys", options.keys, "Folder with server.key and allowed-clients")->required();
  app.add_option("--replay", options.replay, "Show this session instead of driving")->default_str("");
  app.add_option("--from", options.replay_from_s, "Simulated second to begin the replay at")
      ->check(number_between(0.0, 1e6));
  app.add_option("--eyes", options.eyes, "Of a replay: whose eyes the screens show, by name in the scenario or number")
      ->default_str("the driver's")
      ->needs("--replay");
  app.add_option("--seconds", options.seconds, "Simulated seconds; 0: until the scenario ends or somebody stops it")
      ->check(number_between(0.0, 1e6));
  app.add_option("--seed", options.seed, "Seed of everything random")->check(seed_number());
  app.add_option("--driver", options.driver, "A simulated driver drives: plain, novice, experienced, tired or escort")
      ->default_str("the rig's");
  app.add_option("--to", options.to,
                 "Guide the driver to a place: a road's name or id, id:s, or x,y (docs/guidance.md)")
      ->type_name("PLACE")
      ->default_str("nobody guides");
  app.add_option("--language", options.language, "Of spoken guidance")->check(CLI::IsMember({"en", "de", "sv"}));
  app.add_option("--parameter", options.parameters, "Of the scenario, instead of its own value; as often as needed")
      ->type_name("NAME=VALUE")
      ->default_str("")
      ->allow_extra_args(false);
  app.add_option("--motion", options.motion, "Table by which the driver's car goes (docs/given-motion.md)")
      ->default_str("none: somebody drives");
  app.add_option("--vehicle", options.vehicle, "Vehicle file, or a name below vehicles/")->default_str("the rig's");
  app.add_option("--models", options.models, "Folder of your own glTF models: NAME.glb replaces NAME")
      ->default_str("none");
  app.add_option("--edits", options.edits, "File of edits over the generated world (docs/editing.md)")
      ->default_str("none")
      ->excludes("--replay");
  app.add_option("--save", options.save,
                 "At the end, write what differs from the generated world to this file of edits")
      ->default_str("nothing is written")
      ->excludes("--replay");
  app.add_option("--participant", options.participant, "The driver's code, for log, summary and report")
      ->default_str("none");
  app.add_option("--about", options.about,
                 "Facts about the driver: group=, condition=, order=, part=, note=, column.NAME=")
      ->type_name("KEY=VALUE")
      ->default_str("")
      ->allow_extra_args(false);
  app.add_flag("--log-samples-only", options.log_samples_only,
               "Log no snapshots: to be measured, not to be shown again");
  app.add_option("--traffic", options.traffic, "Engine of the traffic: own or sumo");
  app.add_option("--wait-for-screens", options.wait_for_screens_s,
                 "Seconds to wait for the rig's screens and car, then drive without those that are missing")
      ->default_str("until all are there, or Enter or the line \"go\"")
      ->check(number_between(0.0, 1e6));
  auto* begin_from =
      app.add_option("--begin-from", options.begin_from, "Begin at a state that this session of the same drive kept")
          ->default_str("")
          ->excludes("--replay")
          ->excludes("--log-samples-only");
  app.add_option("--begin-at", options.begin_at_s, "Simulated second: begin at the newest state kept until then")
      ->check(number_between(0.0, 1e6))
      ->needs(begin_from);
  app.add_flag("--start-now", options.start_now, "Do not wait until the driver presses a key or a pedal");
  app.add_flag("--lockstep", options.lockstep, "Wait for every screen; simulated time only");
  app.add_flag("--no-screens", options.no_screens, "As fast as it goes, without screens");
  app.add_flag("--no-sound", options.no_sound, "Silent, also where the rig has a sound");
  app.add_option("--page", options.page_port, "Port of the operator's page on 127.0.0.1; 0: any free one")
      ->default_str("no page")
      ->check(CLI::Range(0, 65535));
  app.add_option("--page-host", options.page_hosts,
                 "Name by which a proxy in front of the page is asked for; as often as needed")
      ->type_name("NAME")
      ->default_str("")
      ->allow_extra_args(false);
  app.add_flag("--any-port", options.any_port, "Take any free port and say which");
  if (const char* handed = std::getenv(page::handover_variable)) options.page_handover = page::read_handover(handed);
  return program::run("septet-server", app, argc, argv,
                      [&] { return server::run_server(options).map(logging::exit_status); });
}
