// The driver's car beside the roads: on standing land, on grass, and in the log.
#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/road/road_position.hpp"
#include "engine/roadside/ground_beside.hpp"
#include "engine/simulation/driver_car.hpp"
#include "tests/engine/physics/vehicle/car.hpp"
#include "tests/engine/physics/vehicle/mechanical_energy.hpp"
#include "tests/engine/road/road_files.hpp"

using namespace septet;
using namespace septet::simulation;

namespace {

/// Level road along x, with the land around it.
Model level_world() {
  Model model;
  road::SmallRoad road{.length_m = 1000.0};
  model.roads = road::read_or_fail(road.xml());
  model.scenario.entities.resize(1);
  model.scenario.entities[0].model = *find_vehicle_model("volvo-s80");
  model.driver_entity = 0;
  model.car = vehicle::read_car("volvo-s80");
  model.obstacles = std::make_shared<const roadside::Obstacles>(model.roads, 1);
  return model;
}

const Model& world() {
  static const Model model = level_world();
  return model;
}

double land_m(const Vec2& p) {
  return roadside::ground_beside(world().roads, world().obstacles->terrain(), p, nullptr).height_m;
}

State car_at(const Vec2& p, double heading_rad, double speed_mps) {
  State state;
  const Vec3 there(p, land_m(p) + 0.05);
  state.car = vehicle::standstill(world().car, {there, glm::angleAxis(heading_rad, Vec3(0.0, 0.0, 1.0))}, speed_mps);
  return state;
}

/// Of the vehicle's origin over the land below it.
double over_land_m(const State& state) {
  const Vec3 origin = driven_car(world(), state).outputs.world_from_vehicle.position_m;
  return origin.z - land_m(Vec2(origin));
}

}  // namespace

TEST_CASE("a car far from every road stands on the land and does not sink") {
  for (const double away_m : {70.0, 150.0, 400.0, 900.0}) {
    CAPTURE(away_m);
    State state = car_at({500.0, away_m}, 0.3, 0.0);
    state.input.parking_brake = true;
    std::vector<Event> events;
    for (int tick = 0; tick < 20 * 120; ++tick) {
      advance_car(world(), state, events);
      REQUIRE(std::abs(over_land_m(state)) < 0.25);
    }
    CHECK(glm::length(state.car.velocity_mps) < 0.3);
  }
}

TEST_CASE("a car that was set far below the ground stands on it from the first tick on, and the log says so") {
  for (const double below_m : {12.0, 50.0, 1000.0, 1e6, 1e9}) {
    CAPTURE(below_m);
    State state = car_at({500.0, -1.5}, 0.0, 10.0);
    state.car.world_from_body.position_m.z -= below_m;
    std::vector<Event> events;
    for (int tick = 0; tick < 3 * 120; ++tick) {
      advance_car(world(), state, events);
      REQUIRE(std::abs(over_land_m(state)) < 0.5);
    }
    CHECK(state.car.bad_numbers == 0);
    CHECK(std::ranges::count(events, "set_on_ground", &Event::kind) == 1);
    CHECK(std::ranges::count(events, "wheel_damage", &Event::kind) == 0);
  }
}

TEST_CASE("the log tells of a car off the roads after five seconds and when it is back") {
  State state = car_at({500.0, 30.0}, 0.0, 0.0);
  std::vector<Event> events;
  for (int tick = 0; tick < 130 * 120; ++tick) advance_car(world(), state, events);
  const auto told = [&](const std::string& text) {
    return std::ranges::count_if(events, [&](const Event& event) {
      return event.kind == "off_road" && event.detail.find(text) != std::string::npos;
    });
  };
  CHECK(told("state=off") == 3);  // At 5, 65 and 125 s.
  CHECK(told("state=off since_s=5.0 distance_m=2") == 1);
  CHECK(told("state=back") == 0);
  State back = car_at({500.0, 0.0}, 0.0, 0.0);
  state.car = back.car;
  advance_car(world(), state, events);
  CHECK(told("state=back after_s=130.") == 1);
}

TEST_CASE("a car that rolls on a meadow slows down several times as fast as on the road") {
  const auto lost_mps = [](double away_m) {
    State state = car_at({300.0, away_m}, 0.0, 15.0);
    state.input.selector = GearSelector::neutral;
    std::vector<Event> events;
    const double before_j = vehicle::mechanical_energy_j(world().car, state.car);
    for (int tick = 0; tick < 3 * 120; ++tick) advance_car(world(), state, events);
    return before_j - vehicle::mechanical_energy_j(world().car, state.car);
  };
  const double road_j = lost_mps(-1.5), meadow_j = lost_mps(-150.0);
  MESSAGE("lost in three seconds: " << road_j << " J on the road, " << meadow_j << " J on a meadow");
  CHECK(meadow_j > 2.0 * road_j);
}

TEST_CASE("a meadow brakes with half of what a road gives and shakes the car") {
  const auto drive = [](double away_m) {
    State state = car_at({300.0, away_m}, 0.0, 20.0);
    state.input.brake = 1.0;
    std::vector<Event> events;
    double shaken = 0.0;
    for (int tick = 0; tick < 120; ++tick) {
      advance_car(world(), state, events);
      shaken = std::max(shaken, std::abs(state.car.acceleration_mps2.z));
    }
    return std::pair(20.0 - glm::length(state.car.velocity_mps), shaken);
  };
  const auto [road_mps, road_shaken] = drive(-1.5);
  const auto [meadow_mps, meadow_shaken] = drive(-150.0);
  MESSAGE("braked by " << road_mps << " and " << meadow_mps << " m/s in a second");
  CHECK(meadow_mps < 0.75 * road_mps);
  CHECK(meadow_mps > 0.25 * road_mps);
  CHECK(meadow_shaken > 1.0);
}

TEST_CASE("a car that leaves the road at speed stays on the ground and gains no energy") {
  for (const double heading_rad : {0.1, 0.3, 0.8, -0.3, -0.8}) {
    CAPTURE(heading_rad);
    State state;
    state.car = vehicle::standstill(world().car,
                                    {Vec3(300.0, -1.5, 0.0), glm::angleAxis(heading_rad, Vec3(0.0, 0.0, 1.0))}, 30.0);
    state.input.selector = GearSelector::neutral;
    std::vector<Event> events;
    const double before_j = vehicle::mechanical_energy_j(world().car, state.car);
    double least_j = before_j;
    for (int tick = 0; tick < 10 * 120; ++tick) {
      advance_car(world(), state, events);
      least_j = std::min(least_j, vehicle::mechanical_energy_j(world().car, state.car));
      REQUIRE(vehicle::mechanical_energy_j(world().car, state.car) < least_j + 20e3);
      REQUIRE(over_land_m(state) > -0.6);
      REQUIRE(over_land_m(state) < 3.0);
    }
    CHECK(state.car.bad_numbers == 0);
  }
}

TEST_CASE("a car that slides off a steep bank stands on the land at its foot") {
  // Banked by 60 degrees, its left edge the lower one, on level land.
  Model model;
  road::SmallRoad road{.length_m = 300.0};
  road.profiles = "<lateralProfile><superelevation s=\"0\" a=\"-1.0\" b=\"0\" c=\"0\" d=\"0\"/></lateralProfile>";
  road.sections = "<laneSection s=\"0\"><center>" + road::lane(0, 0) + "</center><right>" + road::lane(-1, 7.0) +
                  "</right></laneSection>";
  model.roads = road::read_or_fail(road.xml());
  model.scenario.entities.resize(1);
  model.scenario.entities[0].model = *find_vehicle_model("volvo-s80");
  model.driver_entity = 0;
  model.car = vehicle::read_car("volvo-s80");
  model.obstacles = std::make_shared<const roadside::Obstacles>(model.roads, 1);
  for (const double speed_mps : {0.0, 10.0, 25.0}) {
    CAPTURE(speed_mps);
    State state;
    state.car =
        vehicle::standstill(model.car, road::world_from_road(road::evaluate(model.roads, {0, 100.0, -3.5})), speed_mps);
    state.input.selector = GearSelector::neutral;
    std::vector<Event> events;
    for (int tick = 0; tick < 12 * 120; ++tick) {
      advance_car(model, state, events);
      REQUIRE(state.car.world_from_body.position_m.z > -12.0);
      REQUIRE(state.car.world_from_body.position_m.z < 20.0);
    }
    CHECK(state.car.bad_numbers == 0);
    const Vec2 at(state.car.world_from_body.position_m);
    const double over_m = state.car.world_from_body.position_m.z -
                          roadside::ground_beside(model.roads, model.obstacles->terrain(), at, nullptr).height_m;
    CHECK(over_m > -0.3);
    CHECK(over_m < 2.0);
  }
}
