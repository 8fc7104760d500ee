/// A queue at a light: how many pass in an hour of green, and what its start costs.
/// Source: Highway Capacity Manual (Transportation Research Board, 2010), chapter 31: from the fifth vehicle on headways are those of saturation.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>

#include "tests/engine/traffic/crossing_cars.hpp"
#include "tests/engine/traffic/crossing_road.hpp"

namespace septet::traffic {
namespace {

struct Discharge {
  double per_hour = 0.0, start_up_loss_s = 0.0;
};

/// The mean over queues whose temperaments are drawn as a swarm's. Cars alone: a lorry counts as more than one.
Discharge discharge(int queues) {
  constexpr std::size_t cars = 20, first_saturated = 4;
  constexpr double tick_s = 1.0 / 30.0, apart_m = 7.0;
  const road::RoadNetwork network = crossing(false, Posted::lights);
  const LaneGraph graph = build_lane_graph(network);
  std::vector<double> passed_s(cars, 0.0);
  for (int queue = 0; queue < queues; ++queue) {
    Random random(static_cast<std::uint64_t>(queue), 7);
    TownState town;
    for (std::size_t k = 0; k < cars; ++k) {
      add_car(network, graph, "south", "north", 3.5 + apart_m * static_cast<double>(k), town);
      TownVehicle& car = town.vehicles.back();
      car.speed_mps = 0.0;
      const double bell = (random.uniform() + random.uniform() + random.uniform()) / 3.0;
      car.driver = driver_in_town(car.driver, 0.5 + 1.5 * (bell - 0.5));
      car.law = FollowingLaw(car.driver.following);
    }
    TrafficLight head;
    head.road = *road::find_road(network, "south");
    std::vector<TrafficLight> lights{head};
    lights.front().lamps.set(Lamp::signal_red, true);
    const auto advance = [&] {
      advance_town(motorway_traffic(0, 1000.0), network, graph, lights, {}, tick_s, random, town);
    };
    for (double t = 0.0; t < 30.0; t += tick_s) advance();  // The queue settles.
    lights.front().lamps = {};
    lights.front().lamps.set(Lamp::signal_green, true);
    const WayIndex arm = town.vehicles.front().route.front();
    const double line_m = graph.ways[arm].length_m - graph.ways[arm].line_before_m;
    std::vector<bool> is_over(cars, false);
    for (double t = tick_s; t < 90.0; t += tick_s) {
      advance();
      for (const TownVehicle& car : town.vehicles) {
        const std::size_t k = car.id - first_car_id;
        if (is_over[k] || (!car.outside && car.route.front() == arm && car.front_m < line_m)) continue;
        is_over[k] = true;
        passed_s[k] += t / queues;
      }
    }
    CHECK(std::ranges::count(is_over, true) == static_cast<std::ptrdiff_t>(cars));
  }
  const double headway_s =
      (passed_s.back() - passed_s[first_saturated - 1]) / static_cast<double>(cars - first_saturated);
  return {3600.0 / headway_s, passed_s[first_saturated - 1] - static_cast<double>(first_saturated) * headway_s};
}

}  // namespace

TEST_CASE(
    "a queue at a light drives off at 1,750 to 1,950 vehicles an hour and lane and loses 1.5 to 2.5 s at its start") {
  const Discharge measured = discharge(20);
  MESSAGE(measured.per_hour << " vehicles/h/lane, start-up loss " << measured.start_up_loss_s << " s");
  CHECK(measured.per_hour > 1750.0);
  CHECK(measured.per_hour < 1950.0);
  CHECK(measured.start_up_loss_s > 1.5);
  CHECK(measured.start_up_loss_s < 2.5);
}

}  // namespace septet::traffic
