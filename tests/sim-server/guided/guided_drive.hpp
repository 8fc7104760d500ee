#pragma once
/// A simulated driver who is guided to a goal: what happens on the way.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "command-line/command/town_scenario.hpp"
#include "engine/simulation/guidance.hpp"
#include "engine/simulation/operator_command.hpp"
#include "engine/world/guidance.hpp"
#include "sim-server/drive/driver_seat.hpp"
#include "sim-server/drive/live_drive.hpp"
#include "tests/conformance/conformance_data.hpp"
#include "tests/sim-server/shipped_drive.hpp"
#include "tests/sim-server/simulated_drive.hpp"
#include "tests/temporary_folder.hpp"

namespace septet::server {

struct GuidedDrive {
  std::optional<double> arrived_s;
  int reroutes = 0, words = 0;
  std::uint32_t collisions = 0;
};

/// Until he arrives, or the time is over.
inline GuidedDrive drive_to(const LoadedDrive& loaded, const std::string& goal, std::uint64_t seed, double most_s) {
  GuidedDrive driven;
  const auto drive = simulated_drive(loaded, "plain", seed);
  const auto begun = drive->command(simulation::GuideDriver{goal});
  REQUIRE_MESSAGE(begun.has_value(), why_not(begun));
  std::uint32_t told = 0;
  while (drive->state().time_s() < most_s && !driven.arrived_s) {
    const auto tick = drive->next(std::nullopt);
    REQUIRE(tick.has_value());
    if (!*tick) break;
    const auto guidance = guidance_of((*tick)->snapshot());
    REQUIRE(guidance.has_value());
    driven.collisions = (*tick)->snapshot().diagnostics.collisions;
    if (guidance->told_count == told) continue;
    told = guidance->told_count;
    ++driven.words;
    if (guidance->told.what == Guided::new_route || guidance->told.what == Guided::no_way) ++driven.reroutes;
    if (guidance->told.what == Guided::arrive && guidance->told.now) driven.arrived_s = drive->state().time_s();
  }
  return driven;
}

/// A public town with the scenario that a road without one gets.
inline LoadedDrive public_town_drive(const std::string& town, const TemporaryFolder& folder) {
  const std::filesystem::path road = folder.path() / (town + ".xodr");
  std::filesystem::copy_file(conformance_data("towns") / (town + ".xodr"), road);
  const auto scenario = scenario_beside(road);
  REQUIRE_MESSAGE(scenario.has_value(), why_not(scenario));
  auto drive = load_drive(DriveFiles{scenario->string(), source_folder() + "/rigs/desktop.toml", 1});
  REQUIRE_MESSAGE(drive.has_value(), why_not(drive));
  return std::move(*drive);
}

inline void reaches(const LoadedDrive& loaded, const std::vector<std::string>& goals, double most_s) {
  std::uint64_t seed = 1;
  for (const std::string& goal : goals) {
    const GuidedDrive driven = drive_to(loaded, goal, seed++, most_s);
    MESSAGE(goal << ": arrived after " << driven.arrived_s.value_or(-1.0) << " s, " << driven.words << " words");
    CAPTURE(goal);
    CHECK(driven.arrived_s.has_value());
    CHECK(driven.reroutes == 0);
    CHECK(driven.collisions == 0);
  }
}

}  // namespace septet::server
