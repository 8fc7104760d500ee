#include <map>

#include "command-line/septet/options.hpp"
#include "program/command_line.hpp"

namespace septet::server {

using program::number_between, program::seed_number;

void add_track_commands(CLI::App& app, Options& options) {
  auto* vehicle_command = app.add_subcommand("vehicle", "A car on the test track");
  vehicle_command->require_subcommand(1);
  auto* vehicle_test =
      vehicle_command->add_subcommand("test", "Run a standard manoeuvre: figures, time series and a plot");
  auto* manoeuvre = vehicle_test->add_option(
      "--manoeuvre", options.track.manoeuvre,
      "steady-circle, step-steer, double-lane-change, sine-with-dwell, stop, coast-down, acceleration or all");
  vehicle_test->add_option("--vehicle", options.track.vehicle, "Vehicle file, or a name of septet list vehicles");
  vehicle_test->add_option("--out", options.track.out, "Folder for the files; without it the figures are only printed");
  auto* inputs = vehicle_test->add_option("--inputs", options.track.inputs,
                                          "Drive these inputs instead: CSV with time_s and any of steering_wheel_deg, "
                                          "accelerator, brake, clutch, gear, parking_brake");
  inputs->excludes(manoeuvre);
  vehicle_test->add_option("--speed", options.track_speed_kmh, "km/h")
      ->default_str("the manoeuvre's")
      ->check(number_between(0.0, 400.0));
  vehicle_test->add_option("--friction", options.track.conditions.friction, "Of the road")
      ->default_str("that for which the tyre is given")
      ->check(number_between(0.01, 3.0));
  vehicle_test
      ->add_option("--amplitude", options.track.amplitude_deg,
                   "Degrees of the hand wheel, for step-steer and sine-with-dwell")
      ->default_str("found by the manoeuvre")
      ->check(number_between(-1500.0, 1500.0));
  vehicle_test
      ->add_option("--esc", options.track.conditions.stability_control,
                   "on or off: the stability control; without it on for sine-with-dwell and --inputs")
      ->transform(CLI::CheckedTransformer(std::map<std::string, bool>{{"on", true}, {"off", false}}));
  vehicle_test->callback([&] {
    if (options.track.manoeuvre.empty() && options.track.inputs.empty())
      throw CLI::RequiredError("--manoeuvre or --inputs");
    options.track.conditions.speed_mps = options.track_speed_kmh / 3.6;
    options.work = [&] { return run_vehicle_test(options.track); };
  });

  auto* traffic_command = app.add_subcommand("traffic", "Septet's traffic on the test track");
  traffic_command->require_subcommand(1);
  auto* traffic_diagram =
      traffic_command->add_subcommand("diagram", "The fundamental diagram: figures, a table and a plot");
  traffic_diagram->add_option("--lanes", options.diagram.lanes, "Of the ring")
      ->check(CLI::Range(1, 8))
      ->capture_default_str();
  traffic_diagram->add_option("--seed", options.diagram.seed, "Of vehicles and drivers")
      ->check(seed_number())
      ->capture_default_str();
  traffic_diagram->add_option("--out", options.diagram.out,
                              "Folder for the files; without it the figures are only printed");
  traffic_diagram->callback([&] { options.work = [&] { return run_traffic_diagram(options.diagram); }; });
}

}  // namespace septet::server
