#pragma once
/// `septet vehicle test`: a car on the test track, figures and a plot.

#include <filesystem>
#include <string>

#include "engine/physics/vehicle/manoeuvre.hpp"

namespace septet::server {

struct VehicleTestOptions {
  std::filesystem::path vehicle;  ///< Parameter file, such as vehicles/volvo-s80.toml.
  std::string manoeuvre;          ///< One of vehicle::manoeuvre_names(), or "all".
  std::filesystem::path
      out;  ///< Folder for NAME.json, NAME.csv and NAME.svg; empty writes nothing.
  std::filesystem::path inputs;  ///< Instead of a manoeuvre: a table of inputs (input_table.hpp).
  double amplitude_deg = 0.0;    ///< Of the hand wheel, for step steer and sine with dwell; 0: found by the manoeuvre.
  vehicle::ManoeuvreOptions conditions;
};

/// Prints the figures of each manoeuvre and writes the files, named VEHICLE-MANOEUVRE. Answers the
/// exit status: 0; 1 after one message on standard error; 2 where a result says nothing about the
/// car, as its output tells.
int run_vehicle_test(const VehicleTestOptions& options);

}  // namespace septet::server
