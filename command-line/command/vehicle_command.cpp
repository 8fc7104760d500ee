#include "command-line/command/vehicle_command.hpp"

#include <cmath>

#include <fmt/core.h>

#include "command-line/command/input_table.hpp"
#include "command-line/command/manoeuvre_files.hpp"
#include "engine/core/regular_file.hpp"
#include "engine/document/text_file.hpp"
#include "engine/math/angle_units.hpp"
#include "engine/physics/vehicle/read_vehicle.hpp"
#include "program/console.hpp"
#include "program/resources.hpp"

namespace septet::server {
namespace {

namespace fs = std::filesystem;

Expected<vehicle::VehicleParameters> load_vehicle(const fs::path& path) {
  return read_regular_file(path).and_then(
      [&](const std::string& text) { return vehicle::read_vehicle(text, path.filename().string()); });
}

Expected<void> write_report(const fs::path& folder, const std::string& car, const vehicle::ManoeuvreReport& report) {
  const std::string name = fmt::format("{}-{}", car, report.manoeuvre);
  return document::write_text_files(folder, {{name + ".json", figures_json(car, report)},
                                             {name + ".csv", series_csv(report)},
                                             {name + ".svg", manoeuvre_svg(car, report)}});
}

/// Warns of conditions that no test track has; they are driven nevertheless.
void warn_of(const vehicle::ManoeuvreOptions& conditions, double steering_ratio) {
  const auto warn = [](const char* what, double value, const char* unit, double low, double high) {
    if (value != 0.0 && !(value >= low && value <= high))
      program::say(fmt::format("septet: warning: {} {:g} {} is outside of what is tested, {:g} to {:g}", what, value,
                               unit, low, high));
  };
  warn("--speed", conditions.speed_mps * 3.6, "km/h", 10.0, 250.0);
  warn("--friction", conditions.friction, "", 0.05, 1.2);
  warn("--amplitude", std::abs(conditions.steer_rad) * steering_ratio * degrees_per_radian, "deg", 1.0, 400.0);
}

}  // namespace

Expected<int> run_vehicle_test(const VehicleTestOptions& options) {
  const auto file = program::find_resource(options.vehicle, "vehicles", ".toml");
  if (!file) return tl::unexpected(file.error());
  const auto parameters = load_vehicle(*file);
  if (!parameters) return tl::unexpected(parameters.error());
  vehicle::ManoeuvreOptions conditions = options.conditions;
  conditions.steer_rad = options.amplitude_deg / degrees_per_radian / parameters->steering.ratio;
  warn_of(conditions, parameters->steering.ratio);
  std::vector<vehicle::ManoeuvreReport> reports;
  if (!options.inputs.empty()) {
    const auto rows = read_regular_file(options.inputs).and_then([&](const std::string& text) {
      return read_input_table(text, options.inputs.filename().string());
    });
    if (!rows) return tl::unexpected(rows.error());
    reports.push_back(vehicle::drive_inputs(*parameters, conditions, *rows));
  } else {
    std::vector<std::string_view> names{options.manoeuvre};
    if (options.manoeuvre == "all") names = vehicle::manoeuvre_names();
    for (const std::string_view name : names) {
      auto report = vehicle::run_manoeuvre(name, *parameters, conditions);
      if (!report) return tl::unexpected(report.error());
      reports.push_back(std::move(*report));
    }
  }
  const std::string car = file->stem().string();
  bool sound = true;
  for (const vehicle::ManoeuvreReport& report : reports) {
    fmt::print("{} {} ({})\n", car, report.manoeuvre, report.standard);
    for (const Figure& figure : report.figures)
      fmt::print("  {:<36} {:>10.4g} {}\n", figure.name, figure.value, figure.unit);
    for (const std::string& fault : report.faults) fmt::print("  no valid result: {}\n", fault);
    sound &= report.faults.empty();
    if (options.out.empty()) continue;
    if (const auto written = write_report(options.out, car, report); !written) return tl::unexpected(written.error());
  }
  return sound ? 0 : 2;
}

}  // namespace septet::server
