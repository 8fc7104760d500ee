// Displays, inputs and forces of the driver's car.

#include "engine/simulation/driver_car.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_position.hpp"
#include "tests/engine/physics/vehicle/car.hpp"
#include "tests/engine/road/road_files.hpp"

using namespace septet;
using namespace septet::simulation;

namespace {

Model model_on(road::RoadNetwork roads) {
  Model model;
  model.roads = std::move(roads);
  model.scenario.entities.resize(1);
  model.scenario.entities[0].model = *find_vehicle_model("volvo-s80");
  model.driver_entity = 0;
  model.car = vehicle::read_car("volvo-s80");
  return model;
}

road::RoadNetwork both_ways() {
  road::SmallRoad road{.length_m = 200.0};
  road.sections = "<laneSection s=\"0\"><left>" + road::lane(1, 3.5) + "</left><center>" + road::lane(0, 0) +
                  "</center><right>" + road::lane(-1, 3.5) + "</right></laneSection>";
  return road::read_or_fail(road.xml());
}

}  // namespace

TEST_CASE("the lateral position is to the left of the driver in either direction of the road") {
  const Model model = model_on(both_ways());
  for (const int lane : {-1, 1}) {
    CAPTURE(lane);
    State state;
    vehicle::VehicleOutputs outputs;
    outputs.world_from_vehicle = road::world_from_lane(road::evaluate_lane(model.roads, {0, lane, 100.0, 0.0}));
    outputs.world_from_vehicle.position_m += outputs.world_from_vehicle.orientation * Vec3(0.0, 0.3, 0.0);
    const DriverCar car = driver_car(model, state, outputs);
    CHECK(car.lane == lane);
    CHECK(car.lane_width_m == doctest::Approx(3.5));
    CHECK(car.lateral_position_m == doctest::Approx(0.3));
  }
}

TEST_CASE("a push changes the car's velocity by the impulse over its mass") {
  const Model model = model_on(both_ways());
  State state;
  state.car = vehicle::standstill(model.car, {}, 10.0);
  DrivenCar car = driven_car(model, state);
  const Vec3 before = state.car.velocity_mps, impulse_ns(1000.0, -500.0, 200.0);
  push_car(model, impulse_ns, state, car);
  CHECK(glm::length((state.car.velocity_mps - before) * model.car.body.mass_kg - impulse_ns) < 1e-6);
  CHECK(car.outputs.speed_mps > 10.1);
}

TEST_CASE("others see the reversing lamps of a car in reverse and the brake lamps of one that brakes") {
  const Model model = model_on(both_ways());
  State state;
  state.car = vehicle::standstill(model.car, {}, 0.0);
  const auto lamps = [&] { return driven_car(model, state).participant.lamps; };
  CHECK_FALSE(lamps().has(Lamp::reverse));
  CHECK_FALSE(lamps().has(Lamp::brake));
  state.car.powertrain.gear = state.car.powertrain.next_gear = -1;
  state.input.brake = 0.5;
  CHECK(lamps().has(Lamp::reverse));
  CHECK(lamps().has(Lamp::brake));
}
