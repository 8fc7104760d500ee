#include "engine/simulation/follow_motion.hpp"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/physics/vehicle/vehicle.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/simulation/given_motion.hpp"

namespace septet::simulation {
namespace {

constexpr double height_reach_m = 60.0;  ///< A start farther from every road keeps the scenario's height.

/// Turns and moves the car in plan to where its table has it now, with its velocity; height, roll and pitch stay those
/// of its springs.
void put_in_plan(const Model& model, const PlanMotion& now, State& state) {
  vehicle::VehicleState& car = state.car;
  const Vec3 forward = car.world_from_body.orientation * Vec3(1.0, 0.0, 0.0);
  const double turn_rad = std::remainder(now.heading_rad - std::atan2(forward.y, forward.x), 2.0 * std::numbers::pi);
  car.world_from_body.orientation =
      glm::normalize(glm::angleAxis(turn_rad, Vec3(0.0, 0.0, 1.0)) * car.world_from_body.orientation);
  Vec3 turning = car.world_from_body.orientation * car.angular_velocity_radps;
  turning.z = now.yaw_rate_radps;
  car.angular_velocity_radps = glm::conjugate(car.world_from_body.orientation) * turning;
  const auto out = vehicle::outputs(model.car, car);
  car.world_from_body.position_m += Vec3(now.place_m - Vec2(out.world_from_vehicle.position_m), 0.0);
  car.velocity_mps += Vec3(now.velocity_mps - Vec2(out.velocity_mps), 0.0);
}

/// The table's motion at the state's time, in the world.
PlanMotion given_now(const Model& model, const State& state) {
  const MotionState& own = *state.motion;
  const double c = std::cos(own.start_heading_rad), s = std::sin(own.start_heading_rad);
  const auto turned = [&](const Vec2& v) { return Vec2(c * v.x - s * v.y, s * v.x + c * v.y); };
  PlanMotion now = motion_at(*model.motion, state.time_s());
  now.place_m = Vec2(own.start_x_m, own.start_y_m) + turned(now.place_m);
  now.velocity_mps = turned(now.velocity_mps);
  now.heading_rad += own.start_heading_rad;
  return now;
}

}  // namespace

void begin_motion(const Model& model, State& state) {
  if (!model.motion) return;
  MotionState& own = state.motion.emplace();
  if (!model.motion->is_path) {
    const RigidTransform& start = state.scenario.entities[model.driver_entity].world_from_entity;
    const Vec3 forward = start.orientation * Vec3(1.0, 0.0, 0.0);
    own = {start.position_m.x, start.position_m.y, std::atan2(forward.y, forward.x)};
  }
  const PlanMotion now = given_now(model, state);
  RigidTransform world_from_vehicle = state.scenario.entities[model.driver_entity].world_from_entity;
  if (const auto place = road::locate(model.roads, now.place_m, nullptr, height_reach_m))
    world_from_vehicle.position_m.z = road::evaluate(model.roads, place->position).position_m.z;
  world_from_vehicle.position_m = Vec3(now.place_m, world_from_vehicle.position_m.z);
  world_from_vehicle.orientation = glm::angleAxis(now.heading_rad, Vec3(0.0, 0.0, 1.0));
  state.car = vehicle::standstill(model.car, world_from_vehicle, glm::length(now.velocity_mps));
  put_in_plan(model, now, state);
}

void follow_motion(const Model& model, bool has_touched, const Vec2& before_mps, State& state) {
  if (!state.motion || state.motion->is_over) return;
  if (state.time_s() > model.motion->end_s() || !state.impacts.empty() || !state.touching.empty() ||
      !state.hull.touches.empty() || has_touched) {
    state.motion->is_over = true;
    return;
  }
  put_in_plan(model, given_now(model, state), state);
  state.car.acceleration_mps2 = Vec3((Vec2(state.car.velocity_mps) - before_mps) / tick_s, 0.0);
  state.car.whole_acceleration_mps2 = state.car.acceleration_mps2;
}

}  // namespace septet::simulation
