#pragma once
/// Commands of `septet-car`: drive, calibrate, try the actuators. Each ends with an error or silently; Ctrl-C ends it,
/// too.

#include <cstdint>
#include <filesystem>
#include <string>

#include "car-io/car_report.hpp"
#include "engine/core/expected.hpp"

namespace septet::car_io {

struct DriveOptions {
  std::string server = "127.0.0.1:4750";
  std::filesystem::path keys;  ///< Folder with car.key (made if missing) and server.public.
};
/// Carries the device's reports to the server and its feedback back, until the drive is over.
Expected<void> run_car(const DriveOptions& options);

struct CalibrateOptions {
  std::filesystem::path rig;
  double seconds = 20.0;
};
/// Records the axes for a while and prints the rig's [car.calibration] on standard output.
Expected<void> run_calibration(const CalibrateOptions& options);

struct LearnOptions {
  std::uint16_t vendor_id = 0, product_id = 0;
  std::string serial;
  double seconds = 4.0;  ///< Per control.
};
/// Asks for each control of a joystick in turn and prints the rig's [car.joystick] on standard output. `device`:
/// "046d:c24f".
Expected<void> run_lesson(const std::string& device, LearnOptions options);

struct ActuateOptions {
  std::filesystem::path rig;
  double seconds = 3.0;
  Actuators actuators;
};
/// Sets fan, shaker and hand wheel to chosen values, for a trial.
Expected<void> run_actuators(const ActuateOptions& options);

struct TrialOptions {
  std::filesystem::path rig;
  double seconds = 2.0;  ///< Per actuator.
};
/// Tries each actuator of the rig, one after the other and gently, within its limits, and prints the expected
/// sensation.
Expected<void> run_trial(const TrialOptions& options);

}  // namespace septet::car_io
