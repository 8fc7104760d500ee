/// Traffic that sees little.

#include <algorithm>
#include <memory>
#include <vector>

#include <doctest/doctest.h>

#include "engine/sight/air.hpp"
#include "engine/traffic/traffic_engine.hpp"
#include "tests/engine/road/road_files.hpp"

namespace septet::traffic {
namespace {

constexpr double within_tick_s = 1.0 / 120.0;

/// Greatest speed of the traffic within 350 m of a standing car once 25 s have passed, of which all saw so far from the fifth on. Others come in at
/// speed at the rims of the swarm.
double fastest_mps(std::optional<double> seen_m) {
  const road::RoadNetwork& network = road::motorway();
  ForeignVehicle car;
  car.id = 1;
  car.world_from_vehicle = road::world_from_lane(road::evaluate_lane(network, {0, -4, 3000.0, 0.0}));
  const auto engine = own_traffic(network, 4);
  engine->start(motorway_traffic(40, 600.0), std::span(&car, 1));
  std::vector<Participant> vehicles;
  for (int tick = 0; tick < 25 * 120; ++tick) {
    std::vector<LimitedSight> sights;
    if (seen_m && tick > 5 * 120)
      for (const Participant& vehicle : vehicles) sights.push_back({vehicle.id, *seen_m});
    engine->limit_sight({.limited = sights, .air = {}, .gone = {}});
    engine->advance(std::span(&car, 1), within_tick_s);
    vehicles.clear();
    engine->append_participants(vehicles);
  }
  double fastest = 0.0;
  for (const Participant& vehicle : vehicles)
    if (glm::distance(vehicle.world_from_vehicle.position_m, car.world_from_vehicle.position_m) < 350.0)
      fastest = std::max(fastest, glm::length(vehicle.velocity_mps));
  return fastest;
}

}  // namespace

TEST_CASE("traffic goes no faster than it can stop within what it sees, and stands where that is nothing") {
  CHECK(fastest_mps(std::nullopt) > 25.0);
  for (const double seen_m : {20.0, 50.0}) {
    // The hardest comfortable braking of any class, 3.1 m/s², and the shortest gap at a stop.
    const double fastest = fastest_mps(seen_m);
    CHECK(fastest < sight::stopping_speed_mps(seen_m, 1.0, 3.2) + 0.1);
    CHECK(fastest > 0.5 * sight::stopping_speed_mps(seen_m, 1.0, 2.0));
  }
  CHECK(fastest_mps(0.0) < 0.3);
}

}  // namespace septet::traffic
