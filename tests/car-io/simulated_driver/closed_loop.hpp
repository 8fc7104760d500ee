#pragma once
// The driver, the S80 and the motorway in a loop, without a server: 120 ticks a second, ten steps
// of the car in each.

#include <string>

#include <doctest/doctest.h>

#include "car-io/car_connection.hpp"
#include "car-io/simulated_driver/simulated_driver.hpp"
#include "engine/core/hash.hpp"
#include "engine/physics/vehicle/vehicle.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/road/lane_links.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/traffic/traffic.hpp"
#include "logging/records.hpp"
#include "tests/engine/physics/vehicle/car.hpp"
#include "tests/engine/road/road_files.hpp"

namespace septet::car_io {

using road::motorway;
using vehicle::read_car;

inline const vehicle::VehicleParameters& volvo() {
  static const vehicle::VehicleParameters car = read_car("volvo-s80");
  return car;
}

class ClosedLoop {
 public:
  static constexpr double tick_s = 1.0 / 120.0;
  static constexpr int steps = 10;
  static constexpr ParticipantId driver_id = 1;

  ClosedLoop(const std::string& driver_name, std::uint64_t seed, int lane, double s_m,
             double speed_mps)
      : ClosedLoop(*find_driver(driver_name), seed, lane, s_m, speed_mps) {}

  ClosedLoop(const DriverParameters& driver, std::uint64_t seed, int lane, double s_m,
             double speed_mps, const vehicle::VehicleParameters& car = volvo())
      : car_(car), person_(driver, seed, motorway()), connection_(person_.opener(), {}) {
    const auto point = road::evaluate_lane(motorway(), {0, lane, s_m, 0.0});
    state_ = vehicle::standstill(car_, road::world_from_lane(point), speed_mps);
    place_ = {0, s_m, point.t_m};
    take_snapshot();
  }

  /// Other vehicles of the next snapshots: `move` fills them for a simulated time.
  std::function<void(double time_s, std::vector<Participant>&)> others;

  void tick() {
    person_.drive(snapshot, tick_s);
    input = connection_.poll(snapshot.simulated_time_s).input;
    vehicle::Ground ground;
    const auto centres = vehicle::wheel_centres_m(car_, state_);
    for (int wheel = 0; wheel < vehicle::wheel_count; ++wheel) {
      const auto surface = road::surface_at(motorway(), Vec2(centres[wheel]), &place_);
      if (!surface) continue;
      ground[wheel].point_m = {centres[wheel].x, centres[wheel].y, surface->height_m};
      ground[wheel].normal = surface->normal;
    }
    for (int i = 0; i < steps; ++i)
      vehicle::advance_vehicle(car_, input, ground, tick_s / steps, state_);
    ++snapshot.tick;
    take_snapshot();
    if (logging::is_sample_due(snapshot.tick, 120.0))
      samples.push_back(logging::take_sample(snapshot, std::nullopt));
  }
  void run(double time_s) {
    for (int i = 0; i < static_cast<int>(time_s / tick_s + 0.5); ++i) tick();
  }

  Snapshot snapshot;
  DriverInput input;
  std::vector<logging::Sample> samples;

  std::uint64_t hash() const {
    StateHash hash;
    vehicle::hash_state(hash, state_);
    return hash.value();
  }

  bool engine_running() const { return state_.powertrain.engine_running; }

 private:
  void take_snapshot() {
    const vehicle::VehicleOutputs out = vehicle::outputs(car_, state_);
    snapshot.simulated_time_s = static_cast<double>(snapshot.tick) * tick_s;
    Participant body;
    body.id = driver_id;
    body.model = *find_vehicle_model("volvo-s80");
    body.world_from_vehicle = out.world_from_vehicle;
    body.velocity_mps = out.velocity_mps;
    body.acceleration_mps2 = out.acceleration_mps2;
    body.angular_velocity_radps = out.angular_velocity_radps;
    snapshot.participants = {body};
    if (others) others(snapshot.simulated_time_s, snapshot.participants);
    DriverCar& car = snapshot.driver_car;
    car.participant = driver_id;
    car.speed_mps = out.speed_mps;
    car.steering_wheel_rad = input.steering_wheel_rad;
    car.accelerator = input.accelerator;
    car.brake = input.brake;
    car.gear = static_cast<std::int8_t>(out.gear);
    car.engine_radps = out.engine_radps;
    car.yaw_rate_radps = out.yaw_rate_radps;
    car.gaze_heading_rad = input.gaze_heading_rad;
    const auto location =
        road::locate(motorway(), Vec2(out.world_from_vehicle.position_m), &place_);
    car.lane = 0;
    if (!location || location->lanes.outside_m > 0.0) return;
    place_ = location->position;
    car.road = place_.road;
    car.road_s_m = place_.s_m;
    car.lane = location->lanes.lane;
    car.lateral_position_m = location->lanes.offset_m;
    car.lane_width_m = road::lane_width_m(motorway(), place_.road, car.lane, place_.s_m);
  }

  vehicle::VehicleParameters car_;
  vehicle::VehicleState state_;
  SimulatedDriverCar person_;
  CarConnection connection_;
  road::RoadPosition place_;
};

/// A vehicle that keeps a lane of the motorway's first road at a constant speed.
inline Participant vehicle_on_motorway(ParticipantId id, const char* model, int lane, double s_m,
                                       double speed_mps) {
  Participant vehicle;
  vehicle.id = id;
  vehicle.model = *find_vehicle_model(model);
  const auto start = road::advance(motorway(), {0, lane, 0.0, 0.0}, s_m).position;
  vehicle.world_from_vehicle = road::world_from_lane(road::evaluate_lane(motorway(), start));
  vehicle.velocity_mps = vehicle.world_from_vehicle.orientation * Vec3(speed_mps, 0, 0);
  return vehicle;
}

}  // namespace septet::car_io
