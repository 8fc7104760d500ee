/// Five hundred vehicle-hours at light, middle and full demand, past the walls of each network, with lights where there are any.

#include <array>
#include <cstdint>
#include <string>

#include <doctest/doctest.h>

#include "tests/conformance/conformance_data.hpp"
#include "tests/engine/traffic/lit_town.hpp"
#include "tests/engine/traffic/public_town.hpp"
#include "tests/shipped_files.hpp"

namespace septet::traffic {
namespace {

road::RoadNetwork many_junctions() {
  const auto path = conformance_data("roads") / "multi_intersections.xodr";
  auto network = road::read_opendrive(text_of(path), path.string());
  REQUIRE(network.has_value());
  return *network;
}

void check_demands(const std::string& name, const LitTown& town, const std::array<std::uint32_t, 3>& demands) {
  CAPTURE(name);
  for (const std::uint32_t count : demands) {
    CAPTURE(count);
    const TownRun run = run_town(town.network, town.graph, motorway_traffic(count, 3000.0), 3600.0, 3001, 1.0 / 30.0,
                                 {}, {}, town.lights_at);
    for (const auto& [a, b] : run.overlaps) MESSAGE("participants " << a << " and " << b << " overlapped");
    const double hours = run.vehicle_s / 3600.0;
    MESSAGE(hours << " vehicle-hours, " << run.mean_mps() << " m/s, overlaps " << run.overlaps.size() << ", reds "
                  << run.reds << " of " << run.lit_lines << ", longest stand " << run.longest_stand_s
                  << " s, hard brakings " << run.hard_brakings / hours << " an hour of driving, least there "
                  << run.least_there);
    CHECK(run.overlaps.empty());
    CHECK(run.reds == 0);
    CHECK(run.longest_stand_s < 180.0);
    CHECK(run.hard_brakings < hours);
    CHECK((run.lit_lines > 0) == static_cast<bool>(town.lights_at));
  }
}

}  // namespace

TEST_CASE("past walls and at lights nobody overlaps, runs a red or stands for three minutes at any demand") {
  check_demands("Town01", walled_town(public_town("Town01")), {15, 40, 100});
  check_demands("Town03", walled_town(public_town("Town03")), {15, 40, 100});
  check_demands("multi_intersections", walled_town(many_junctions()), {15, 40, 100});
  check_demands("scenarios/town", shipped_town(), {60, 150, 300});
}

}  // namespace septet::traffic
