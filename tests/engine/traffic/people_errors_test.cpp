/// Errors of people on the crossing of crossing_road.hpp.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/traffic/network/town.hpp"
#include "tests/engine/traffic/crossing_cars.hpp"
#include "tests/engine/traffic/crossing_road.hpp"
#include "tests/engine/traffic/town_run.hpp"

namespace septet::traffic {
namespace {

constexpr double encounter_step_s = 1.0 / 30.0;
constexpr ParticipantId driver_id = 1;

/// The driver's car on the lane from south to north.
ForeignVehicle driver_from_south(double before_m, double speed_mps) {
  ForeignVehicle driver;
  driver.id = driver_id;
  driver.model = *find_vehicle_model("volvo-s80");
  driver.world_from_vehicle = {{0.5 * lane_m, -arm_end_m - before_m, 0.0},
                               orientation_from_angles(0.5 * std::numbers::pi, 0.0, 0.0)};
  driver.velocity_mps = {0.0, speed_mps, 0.0};
  return driver;
}

DriverError error_of_first(PeopleError kind, double lasts_s) {
  DriverError error;
  error.who = first_car_id;
  error.kind = kind;
  error.lasts_s = lasts_s;
  return error;
}

/// A town's first car and the driver's, driven.
struct Encounter {
  road::RoadNetwork network = crossing(false, Posted::signs);
  LaneGraph graph = build_lane_graph(network);
  TownState town;
  std::vector<ForeignVehicle> foreign;
  std::vector<TrafficLight> lights;
  Random random{1};
  double time_s = 0.0;

  TownVehicle& car() { return town.vehicles.front(); }
  void step() {
    for (ForeignVehicle& other : foreign) other.world_from_vehicle.position_m += encounter_step_s * other.velocity_mps;
    advance_town(motorway_traffic(0, 1000.0), network, graph, lights, foreign, encounter_step_s, random, town);
    time_s += encounter_step_s;
  }
  /// The town's first car is past its line.
  bool has_entered() { return graph.ways[car().route.front()].in_junction() || car().front_m > arm_m(); }
  double arm_m() { return graph.ways[car().route.front()].length_m; }
  void show(Lamp lamp, const char* arm = "south") {
    TrafficLight head;
    head.road = *road::find_road(network, arm);
    head.lamps.set(lamp, true);
    lights = {head};
  }
};

/// How much the town's car is before the driver's on the crossing, in seconds; negative: it lets it pass.
double before_driver_s(bool is_wished) {
  Encounter on;
  add_car(on.network, on.graph, "west", "east", 60.0, on.town);
  on.foreign = {driver_from_south(80.0, 13.0)};
  if (is_wished) CHECK(overlook({}, driver_id, on.town).has_value());
  std::optional<double> entered_s, passed_s;
  while (on.time_s < 20.0 && !(entered_s && passed_s)) {
    on.step();
    if (!entered_s && on.has_entered()) entered_s = on.time_s;
    if (!passed_s && on.foreign.front().world_from_vehicle.position_m.y > 0.0) passed_s = on.time_s;
  }
  REQUIRE(entered_s.has_value());
  REQUIRE(passed_s.has_value());
  return *passed_s - *entered_s;
}

}  // namespace

TEST_CASE("who overlooks the driver's car claims a crossing before it, and without the error lets it pass") {
  CHECK(before_driver_s(false) < 0.0);
  CHECK(before_driver_s(true) > 0.5);
}

TEST_CASE("the one who overlooks is told as it begins and, with how near they came, once the two have parted") {
  Encounter on;
  add_car(on.network, on.graph, "west", "east", 60.0, on.town);
  on.foreign = {driver_from_south(80.0, 13.0)};
  REQUIRE(overlook({}, driver_id, on.town).has_value());
  CHECK_FALSE(overlook({}, driver_id, on.town).has_value());
  while (on.time_s < 20.0) on.step();
  const auto& told = on.town.errors.told;
  REQUIRE(told.size() == 2);
  for (const ToldError& one : told) {
    CHECK(one.who == first_car_id);
    CHECK(one.whom == driver_id);
  }
  CHECK_FALSE(told.front().end.has_value());
  CHECK(told.back().end == ErrorEnd::parted);
  CHECK(told.back().nearest_m.value() < 25.0);
  CHECK(told.back().lasted_s > 1.0);
  CHECK_FALSE(on.town.errors.any());
}

TEST_CASE("a wish for which nobody has to give way is told after two minutes") {
  Encounter on;
  add_car(on.network, on.graph, "west", "east", 60.0, on.town);
  REQUIRE(overlook({}, driver_id, on.town).has_value());
  while (on.time_s < 121.0) on.step();
  REQUIRE(on.town.errors.told.size() == 1);
  CHECK(on.town.errors.told.front().end == ErrorEnd::unmet);
  CHECK_FALSE(on.town.errors.told.front().who.has_value());
}

TEST_CASE("once an encounter is over he sees the other again") {
  // Held at his line by one who stands beyond it, until the driver's car has passed and comes a second time.
  const auto claims_before_second = [](bool overlooks_again) {
    Encounter on;
    add_car(on.network, on.graph, "west", "east", 25.0, on.town);
    ForeignVehicle stands = driver_from_south(0.0, 0.0);
    stands.id = 2;
    stands.world_from_vehicle = {{arm_end_m + 3.0, -0.5 * lane_m, 0.0}, orientation_from_angles(0.0, 0.0, 0.0)};
    on.foreign = {driver_from_south(40.0, 13.0), stands};
    REQUIRE(overlook(first_car_id, driver_id, on.town).has_value());
    while (on.time_s < 7.5) on.step();
    CHECK_FALSE(on.has_entered());
    CHECK(on.town.errors.told.back().end == ErrorEnd::parted);
    on.foreign.front() = driver_from_south(50.0, 13.0);
    on.foreign.back().world_from_vehicle.position_m.x = 500.0;
    if (overlooks_again) REQUIRE(overlook(first_car_id, driver_id, on.town).has_value());
    while (on.foreign.front().world_from_vehicle.position_m.y < -arm_end_m) on.step();
    return !on.car().claims.empty();
  };
  CHECK_FALSE(claims_before_second(false));
  CHECK(claims_before_second(true));
}

TEST_CASE("who overlooks the one ahead runs into him, which ends it") {
  const auto nearest_m = [](bool overlooks) {
    Encounter on;
    add_car(on.network, on.graph, "south", "north", 120.0, on.town);
    on.foreign = {driver_from_south(60.0, 0.0)};
    if (overlooks) REQUIRE(overlook(first_car_id, driver_id, on.town).has_value());
    double least_m = 1e300;
    while (on.time_s < 15.0 && (on.town.errors.told.empty() || !on.town.errors.told.back().end)) {
      on.step();
      least_m = std::min(least_m,
                         200.0 - 60.0 - vehicle_models()[on.foreign.front().model].rear_overhang_m - on.car().front_m);
    }
    if (overlooks) CHECK(on.town.errors.told.back().end == ErrorEnd::touched);
    return least_m;
  };
  CHECK(nearest_m(false) > 1.0);
  CHECK(nearest_m(true) < 0.1);
}

TEST_CASE("who errs at red passes a light that has just turned, and one that has been red stops him") {
  const auto passes = [](bool errs, double red_from_s) {
    Encounter on;
    on.network = crossing(false, Posted::lights);
    on.graph = build_lane_graph(on.network);
    add_car(on.network, on.graph, "south", "north", 60.0, on.town);
    on.car().speed_mps = 13.0;
    if (errs) on.town.errors.drivers = {error_of_first(PeopleError::red, 2.0)};
    while (on.time_s < 12.0) {
      on.show(on.time_s > red_from_s         ? Lamp::signal_red
              : on.time_s > red_from_s - 3.0 ? Lamp::signal_amber
                                             : Lamp::signal_green);
      on.step();
    }
    const bool has_passed = on.network.roads[on.graph.ways[on.car().route.front()].road].id != "south";
    const auto& told = on.town.errors.told;
    if (has_passed && errs) CHECK((told.size() == 2 && told.back().end == ErrorEnd::passed));
    if (!has_passed) CHECK(told.empty());
    return has_passed;
  };
  CHECK_FALSE(passes(false, 3.5));
  CHECK(passes(true, 3.5));
  CHECK_FALSE(passes(true, 0.5));
}

TEST_CASE("who brakes late begins to brake for the driver's car seconds after its brake lamps") {
  const auto brakes_after_s = [](double late_s) {
    Encounter on;
    add_car(on.network, on.graph, "south", "north", 120.0, on.town);
    on.foreign = {driver_from_south(100.0, 10.0)};
    if (late_s > 0.0) on.town.errors.drivers = {error_of_first(PeopleError::late_brake, late_s)};
    constexpr double from_s = 1.0, hard_mps2 = 5.0;
    while (on.time_s < from_s) on.step();
    on.foreign.front().lamps.set(Lamp::brake, true);
    while (on.time_s < 10.0 && on.car().acceleration_mps2 > -1.5) {
      on.foreign.front().velocity_mps.y = std::max(0.0, 10.0 - hard_mps2 * (on.time_s - from_s));
      on.step();
    }
    return on.time_s - from_s;
  };
  const double usual_s = brakes_after_s(0.0);
  CHECK(usual_s < 1.0);
  CHECK(std::abs(brakes_after_s(2.0) - 2.0) < 0.1);
}

TEST_CASE("who telephones at a light drives off when the call is over, not when it turns green") {
  const auto goes_after_s = [](double telephone_s) {
    Encounter on;
    on.network = crossing(false, Posted::lights);
    on.graph = build_lane_graph(on.network);
    on.show(Lamp::signal_red);
    add_car(on.network, on.graph, "south", "north", 20.0, on.town);
    on.car().speed_mps = 5.0;
    while (on.time_s < 15.0) on.step();
    REQUIRE(on.car().speed_mps < 0.1);
    on.show(Lamp::signal_green);
    if (telephone_s > 0.0) on.town.errors.drivers = {error_of_first(PeopleError::telephone, telephone_s)};
    while (on.car().speed_mps < 0.5 && on.time_s < 30.0) on.step();
    return on.time_s - 15.0;
  };
  const double usual_s = goes_after_s(0.0);
  CHECK(usual_s < 2.0);
  CHECK(std::abs(goes_after_s(4.0) - (usual_s + 4.0)) < 0.3);
}

TEST_CASE("a wish names a vehicle of the traffic that is there and does not err") {
  Encounter on;
  add_car(on.network, on.graph, "west", "east", 60.0, on.town);
  CHECK_FALSE(overlook(first_car_id + 1, driver_id, on.town).has_value());
  CHECK_FALSE(overlook(first_car_id, first_car_id, on.town).has_value());
  CHECK(overlook(first_car_id, driver_id, on.town).has_value());
  CHECK_FALSE(overlook(first_car_id, driver_id, on.town).has_value());
}

}  // namespace septet::traffic
