#include "command-line/command/check_rig.hpp"

#include <cstdlib>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "car-io/can/rig_can.hpp"
#include "car-io/car_layout.hpp"
#include "engine/core/regular_file.hpp"
#include "engine/driver/driver_parameters.hpp"
#include "engine/physics/vehicle/read_vehicle.hpp"
#include "engine/rig/rig.hpp"
#include "engine/rig/rig_doubts.hpp"
#include "program/resources.hpp"

namespace septet::server {
namespace {

using road::Finding;
using road::Severity;

Expected<void> check_vehicle(const std::string& name) {
  return program::find_resource(name, "vehicles", ".toml").and_then([](const std::filesystem::path& path) {
    return read_regular_file(path).and_then([&](const std::string& text) -> Expected<void> {
      if (const auto vehicle = vehicle::read_vehicle(text, path.string()); !vehicle)
        return tl::unexpected(vehicle.error());
      return {};
    });
  });
}

/// Place of a fault in something that the rig names, preceded by the rig's file and key.
std::string named_at(const std::filesystem::path& file, std::string_view key, std::string_view where) {
  constexpr std::string_view unnamed = "rig, ";
  if (where.empty() || where == "the rig") return fmt::format("{}, {}", file.string(), key);
  if (where.starts_with(unnamed)) return fmt::format("{}, {}", file.string(), where.substr(unnamed.size()));
  return fmt::format("{}, {}: {}", file.string(), key, where);
}

}  // namespace

std::vector<Finding> check_rig(const std::string& text, const std::filesystem::path& file) {
  std::vector<Finding> findings;
  const auto add = [&](Severity severity, const Error& error) {
    const std::string here = file.string() + ":";
    const int line = error.where.starts_with(here) ? std::atoi(error.where.c_str() + here.size()) : 0;
    findings.push_back({severity, line, error});
  };
  const auto rig = rig::read_rig(text, file.string());
  if (!rig) {
    add(Severity::error, rig.error());
    return findings;
  }
  const auto add_named = [&](Severity severity, std::string_view key, Error error) {
    error.where = named_at(file, key, error.where);
    add(severity, error);
  };
  const auto must_hold = [&](std::string_view key, const auto& expected) {
    if (!expected) add_named(Severity::error, key, expected.error());
  };
  must_hold("[car] vehicle", check_vehicle(rig->car.vehicle));
  must_hold("[car] layout", car_io::find_car_layout(rig->car.layout));
  must_hold("[car] driver", driver::find_driver(rig->car.driver));
  if (rig->can) {
    const auto can = car_io::read_rig_can(*rig, file);
    must_hold("[can]", can);
    if (can && can->notice) add_named(Severity::warning, "[can] dbc", *can->notice);
  }
  for (const Error& doubt : rig::doubts_of(*rig, file.string())) add(Severity::warning, doubt);
  return findings;
}

}  // namespace septet::server
