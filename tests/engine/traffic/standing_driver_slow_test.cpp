// A swarm about one who stands on the shipped motorway.

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "engine/road/opendrive_reader.hpp"
#include "tests/engine/traffic/ring_road.hpp"
#include "tests/shipped_files.hpp"

namespace septet::traffic {
namespace {

/// Vehicles on the road within the radius, and how far from the driver the nearest one came in.
struct Around {
  int vehicles = 0;
  double nearest_entry_m = 1e9;
};

Around after_standing(double x_m, int lane, double seconds, std::uint32_t count) {
  const auto network =
      road::read_opendrive(shipped_text("scenarios/motorway-ambulance/motorway.xodr"), "motorway.xodr");
  REQUIRE(network.has_value());
  const Corridor corridor = build_corridor(*network, {0, -3, 1000.0, 0.0});
  std::vector<ForeignVehicle> foreign(1);
  foreign[0].model = model_named("volvo-s80");
  foreign[0].world_from_vehicle =
      road::world_from_lane(road::evaluate_lane(*network, position_at(corridor, x_m, lane)));
  const TrafficParameters parameters = motorway_traffic(count, 1500.0);
  Random random(3, 1);
  TrafficState state = populate(parameters, *network, foreign, random);
  constexpr double tick_s = 1.0 / 30.0;
  Around around;
  std::vector<std::int16_t> was_lane;
  for (int tick = 0; tick * tick_s < seconds; ++tick) {
    was_lane = state.corridors[0].lane;
    advance(parameters, *network, foreign, tick_s, random, state);
    const CorridorTraffic& own = state.corridors[0];
    for (std::size_t i = 0; i < own.size(); ++i)
      if (was_lane[i] == 0 && own.lane[i] != 0)
        around.nearest_entry_m = std::min(around.nearest_entry_m, std::abs(own.x_m[i] - x_m));
  }
  for (const CorridorTraffic& traffic : state.corridors)
    around.vehicles += static_cast<int>(std::ranges::count_if(traffic.lane, [](auto l) { return l > 0; }));
  return around;
}

}  // namespace

TEST_CASE(
    "a driver who stands for three minutes has nine tenths of the asked number around him, who came from behind") {
  constexpr std::uint32_t count = 200;
  for (const double x_m : {800.0, 3000.0}) {
    const Around around = after_standing(x_m, 1, 180.0, count);
    MESSAGE(around.vehicles << " of " << count << " at " << x_m << " m, nearest entry " << around.nearest_entry_m
                            << " m");
    CHECK(around.vehicles >= 180);
    CHECK(around.nearest_entry_m > 600.0);
  }
}

}  // namespace septet::traffic
