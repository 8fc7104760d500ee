/// `septet-car`: the car's HID device, on the machine that it is plugged into.

#include <string>

#include "car-io/program/car_program.hpp"
#include "car-io/program/game_program.hpp"
#include "engine/core/version.hpp"
#include "program/command_line.hpp"

int main(int argc, char** argv) {
  using namespace septet;
  using program::number_between;
  car_io::DriveOptions drive;
  car_io::CalibrateOptions calibrate;
  car_io::ActuateOptions actuate;
  car_io::TrialOptions all;
  car_io::LearnOptions learn;
  CLI::App app{
      "septet-car: carries the car's controls to the server, and fan, vibration and steering force "
      "to the car. Run it on the machine that the rig's [car] machine names."};
  app.option_defaults()->always_capture_default();
  app.set_version_flag("--version", version_text());
  app.add_option("--server", drive.server, "Server's address and port");
  app.add_option("--keys", drive.keys, "Folder with server.public, and car.key, made if missing");

  std::string device;
  CLI::App* calibration = app.add_subcommand(
      "calibrate",
      "Record the axes of a rig's car and print its [car.calibration]; of a joystick that no rig knows: learn");
  CLI::Option_group* which = calibration->add_option_group("Which", "One of these");
  which->add_option("--rig", calibrate.rig, "Rig file");
  which->add_option("device", device, "VENDOR:PRODUCT of a joystick to learn, as septet devices shows it");
  which->require_option(1);
  calibration->add_option("--seconds", calibrate.seconds, "How long; of a joystick for each control")
      ->check(number_between(0.1, 600.0));

  CLI::App* trial = app.add_subcommand("try", "Set fan, vibration and steering force for a while");
  trial->add_option("--rig", actuate.rig, "Rig file")->required();
  trial->add_option("--seconds", actuate.seconds, "How long")->check(number_between(0.1, 600.0));
  trial->add_option("--fan", actuate.actuators.fan, "0 to 1")->check(number_between(0.0, 1.0));
  trial->add_option("--vibration", actuate.actuators.vibration, "0 to 1")->check(number_between(0.0, 1.0));
  trial->add_option("--hz", actuate.actuators.vibration_hz, "Frequency")->check(number_between(0.0, 255.0));
  trial->add_option("--steering", actuate.actuators.steering, "-1 (right) to 1 (left)")
      ->check(number_between(-1.0, 1.0));
  CLI::App* lesson = app.add_subcommand("learn", "Find out a joystick's axes and buttons and print [car.joystick]");
  lesson->add_option("device", device, "VENDOR:PRODUCT as septet devices shows it, such as 046d:c24f")->required();
  lesson->add_option("--serial", learn.serial, "Where there are several");
  lesson->add_option("--seconds", learn.seconds, "For each control")->check(number_between(0.1, 60.0));

  CLI::App* test = app.add_subcommand("test", "Try each actuator that the rig has, gently, one after the other");
  test->add_option("--rig", all.rig, "Rig file")->required();
  test->add_option("--seconds", all.seconds, "How long each")->check(number_between(0.1, 60.0));
  car_io::ServeOptions serve;
  CLI::App* games = app.add_subcommand("serve", "Be a wheel with force feedback to a commercial game");
  games->add_option("--rig", serve.rig, "Rig file")->required();
  games
      ->add_option("--game", serve.games,
                   "Telemetry that moves fan, shaker and instruments: outgauge, outsim, codemasters or a TOML file, "
                   "with =PORT where it is "
                   "not the usual one; may be repeated")
      ->default_str("none");
  games->add_option("--listen", serve.listen, "Address at which telemetry is heard; 0.0.0.0: from other machines too");
  app.require_subcommand(0, 1);
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return "septet-car: " + std::string(error.what()) + "; --help lists the options\n";
  });
  return program::run("septet-car", app, argc, argv, [&] {
    if (calibration->count("--seconds") > 0) learn.seconds = calibrate.seconds;
    const auto done = calibration->parsed() && device.empty()     ? car_io::run_calibration(calibrate)
                      : trial->parsed()                           ? car_io::run_actuators(actuate)
                      : test->parsed()                            ? car_io::run_trial(all)
                      : lesson->parsed() || calibration->parsed() ? car_io::run_lesson(device, learn)
                      : games->parsed()                           ? car_io::run_serve(serve)
                                                                  : car_io::run_car(drive);
    return done.map([] { return 0; });
  });
}
