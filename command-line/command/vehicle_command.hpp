#pragma once
/// `septet vehicle test`: a car on the test track, figures and a plot.

#include <filesystem>
#include <string>

#include "engine/core/expected.hpp"
#include "engine/physics/vehicle/manoeuvre.hpp"

namespace septet::server {

struct VehicleTestOptions {
  std::string vehicle = "volvo-s80";  ///< A file, or a name below vehicles/.
  std::string manoeuvre;              ///< One of vehicle::manoeuvre_names(), or "all".
  std::filesystem::path out;          ///< Folder for NAME.json, NAME.csv and NAME.svg; empty writes nothing.
  std::filesystem::path inputs;       ///< Instead of a manoeuvre: a table of inputs (input_table.hpp).
  /// Amplitude of the hand wheel, for step steer and sine with dwell; 0: determined by the manoeuvre.
  double amplitude_deg = 0.0;
  vehicle::ManoeuvreOptions conditions;
};

/// Prints the figures of each manoeuvre and writes the files, named VEHICLE-MANOEUVRE. Returns 2 if a result is not
/// meaningful for the car, as its output explains.
Expected<int> run_vehicle_test(const VehicleTestOptions& options);

}  // namespace septet::server
