#include "sim-server/command/vehicle_command.hpp"

#include <cstdio>

#include <fmt/core.h>

#include "engine/core/regular_file.hpp"
#include "engine/physics/vehicle/read_vehicle.hpp"
#include "sim-server/command/manoeuvre_files.hpp"
#include "sim-server/command/text_files.hpp"

namespace septet::server {
namespace {

namespace fs = std::filesystem;

Expected<vehicle::VehicleParameters> load_vehicle(const fs::path& path) {
  return read_regular_file(path).and_then([&](const std::string& text) {
    return vehicle::read_vehicle(text, path.filename().string());
  });
}

Expected<void> write_report(const VehicleTestOptions& options,
                            const vehicle::ManoeuvreReport& report) {
  const std::string car = options.vehicle.stem().string();
  const std::string name = fmt::format("{}-{}", car, report.manoeuvre);
  return write_text_files(options.out, {{name + ".json", figures_json(car, report)},
                                        {name + ".csv", series_csv(report)},
                                        {name + ".svg", manoeuvre_svg(car, report)}});
}

Expected<void> test_vehicle(const VehicleTestOptions& options) {
  const auto parameters = load_vehicle(options.vehicle);
  if (!parameters) return tl::unexpected<Error>(parameters.error());
  std::vector<std::string_view> names{options.manoeuvre};
  if (options.manoeuvre == "all") names = vehicle::manoeuvre_names();
  for (const std::string_view name : names) {
    const auto report = vehicle::run_manoeuvre(name, *parameters, options.conditions);
    if (!report) return tl::unexpected<Error>(report.error());
    fmt::print("{} {} ({})\n", options.vehicle.stem().string(), report->manoeuvre,
               report->standard);
    for (const Figure& figure : report->figures)
      fmt::print("  {:<36} {:>10.4g} {}\n", figure.name, figure.value, figure.unit);
    if (options.out.empty()) continue;
    if (const auto written = write_report(options, *report); !written) return written;
  }
  return {};
}

}  // namespace

int run_vehicle_test(const VehicleTestOptions& options) {
  const auto done = test_vehicle(options);
  if (done) return 0;
  fmt::print(stderr, "septet: {}\n", describe(done.error()));
  return 1;
}

}  // namespace septet::server
