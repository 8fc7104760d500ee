#include "engine/simulation/bodies/loose_body.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/simulation/effects/body_box.hpp"
#include "engine/world/vehicle_body.hpp"

namespace septet::simulation {
namespace {

/// Heading as that of the forward axis in plan; upright along `up`.
Quat orientation_on(const Vec3& up, double heading_rad) {
  const Vec2 way(std::cos(heading_rad), std::sin(heading_rad));
  const Vec3 forward = glm::normalize(Vec3(way, -glm::dot(Vec2(up), way) / up.z));
  return glm::quat_cast(glm::dmat3(forward, glm::cross(up, forward), up));
}

/// From the vehicle's origin to the middle of its box, world frame.
Vec3 arm_of(ModelIndex model, const Quat& orientation) {
  const VehicleModel& shape = vehicle_models()[model];
  const double middle_m = 0.5 * (vehicle_body(shape.kind).clearance_m + shape.height_m);
  return orientation * Vec3(shape.centre_x_m(), 0.0, middle_m);
}

}  // namespace

double mass_kg(const Model& model, const Participant& participant) {
  if (participant.id == driver_participant) return model.car.body.mass_kg;
  const std::size_t entity = participant.id - first_scripted_participant;
  if (participant.id >= first_scripted_participant && entity < model.scenario.entities.size())
    if (const double told_kg = model.scenario.entities[entity].mass_kg; told_kg > 0.0) return told_kg;
  return vehicle_body(vehicle_models()[participant.model].kind).mass_kg;
}

double mass_centre_ahead_m(const Model& model, const Participant& participant) {
  return participant.id == driver_participant ? model.car.body.mass_centre_x_m
                                              : vehicle_models()[participant.model].centre_x_m();
}

impact::Side impact_side(const Participant& participant, double mass_kg) {
  const debris::Box box = body_box(participant);
  impact::Side side;
  side.outline = outline_of(box);
  side.body.mass_kg = mass_kg;
  side.body.yaw_inertia_kgm2 = mass_kg / 3.0 * glm::dot(side.outline.half_m, side.outline.half_m);
  side.body.mass_centre_m = side.outline.centre_m;
  side.body.velocity_mps = Vec2(box.velocity_mps);
  side.body.yaw_rate_radps = participant.angular_velocity_radps.z;
  side.body.heading_rad = std::atan2(side.outline.forward.y, side.outline.forward.x);
  side.crush = passenger_car_crush();
  return side;
}

LooseBody loose_body(const Participant& participant, double mass_kg) {
  LooseBody loose;
  loose.id = participant.id;
  loose.model = participant.model;
  loose.paint = participant.paint;
  loose.lamps = participant.lamps;
  for (const Lamp lamp : {Lamp::indicator_left, Lamp::indicator_right}) loose.lamps.set(lamp, false);
  loose.front_steer_rad = participant.front_steer_rad;
  loose.wheel_spin_rad = participant.wheel_spin_rad;
  loose.body = impact_side(participant, mass_kg).body;
  loose.height_m = participant.world_from_vehicle.position_m.z;
  loose.up = participant.world_from_vehicle.orientation * Vec3(0.0, 0.0, 1.0);
  loose.climb_mps = participant.velocity_mps.z;
  loose.acceleration_mps2 = Vec2(participant.acceleration_mps2);
  return loose;
}

Participant participant_of(const LooseBody& loose) {
  Participant participant;
  participant.id = loose.id;
  participant.model = loose.model;
  participant.paint = loose.paint;
  participant.lamps = loose.lamps;
  participant.lamps.set(Lamp::brake, true);
  participant.front_steer_rad = loose.front_steer_rad;
  participant.wheel_spin_rad = loose.wheel_spin_rad;
  RigidTransform& place = participant.world_from_vehicle;
  place.orientation = orientation_on(loose.up, loose.body.heading_rad);
  const Vec3 arm_m = arm_of(loose.model, place.orientation);
  place.position_m = Vec3(loose.body.mass_centre_m - Vec2(arm_m), loose.height_m);
  participant.angular_velocity_radps = Vec3(0.0, 0.0, loose.body.yaw_rate_radps);
  participant.velocity_mps = Vec3(impact::velocity_at(loose.body, -Vec2(arm_m)), loose.climb_mps);
  participant.acceleration_mps2 = Vec3(loose.acceleration_mps2, 0.0);
  return participant;
}

impact::Side side_of(const LooseBody& loose) {
  impact::Side side = impact_side(participant_of(loose), loose.body.mass_kg);
  side.body = loose.body;
  return side;
}

vehicle::LockedWheels locked_wheels(const VehicleModel& model,
                                    const std::array<double, vehicle::wheel_count>& friction) {
  vehicle::LockedWheels wheels;
  const double wheelbase_m = std::max(model.wheelbase_m, 0.1);
  const double front_share = std::clamp(model.centre_x_m() / wheelbase_m, 0.1, 0.9);
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    const bool front = i < 2, left = i % 2 == 0;
    wheels[i].arm_m = {(front ? model.wheelbase_m : 0.0) - model.centre_x_m(), (left ? 0.5 : -0.5) * model.track_m};
    wheels[i].load_share = 0.5 * (front ? front_share : 1.0 - front_share);
    wheels[i].friction = vehicle::locked_share * friction[i];
  }
  return wheels;
}

}  // namespace septet::simulation
