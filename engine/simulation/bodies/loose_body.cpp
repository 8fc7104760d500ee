#include "engine/simulation/bodies/loose_body.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/scenario/model/misc_object.hpp"
#include "engine/simulation/effects/body_box.hpp"
#include "engine/world/participant_shape.hpp"
#include "engine/world/solid.hpp"
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
Vec3 arm_of(const VehicleModel& shape, const Quat& orientation) {
  return orientation * Vec3(shape.centre_x_m(), 0.0, middle_height_m(shape));
}

VehicleModel shape_of(const LooseBody& loose) {
  return loose.model == box_model() ? box_shape(loose.box_size_m) : vehicle_models()[loose.model];
}

}  // namespace

double mass_kg(const Model& model, const Participant& participant) {
  if (participant.id == driver_participant) return model.car.body.mass_kg;
  if (is_solid(participant.id)) return std::numeric_limits<double>::infinity();
  const std::size_t entity = participant.id - first_scripted_participant;
  if (participant.id >= first_scripted_participant && entity < model.scenario.entities.size()) {
    const scenario::Entity& of = model.scenario.entities[entity];
    if (is_box(participant)) return scenario::pushed_kg(of);
    if (of.mass_kg > 0.0) return of.mass_kg;
  }
  return vehicle_body(vehicle_models()[participant.model].kind).mass_kg;
}

double mass_centre_ahead_m(const Model& model, const Participant& participant) {
  return participant.id == driver_participant ? model.car.body.mass_centre_x_m
                                              : septet::shape_of(participant).centre_x_m();
}

impact::Side impact_side(const Participant& participant, double mass_kg) {
  const debris::Box box = body_box(participant);
  impact::Side side;
  side.outline = outline_of(box, corner_m(participant));
  side.body.mass_kg = mass_kg;
  side.body.yaw_inertia_kgm2 = mass_kg / 3.0 * glm::dot(side.outline.half_m, side.outline.half_m);
  side.body.mass_centre_m = side.outline.centre_m;
  side.body.velocity_mps = Vec2(box.velocity_mps);
  side.body.yaw_rate_radps = participant.angular_velocity_radps.z;
  side.body.heading_rad = std::atan2(side.outline.forward.y, side.outline.forward.x);
  side.crush = is_box(participant) ? box_crush() : passenger_car_crush();
  return side;
}

LooseBody loose_body(const Participant& participant, double mass_kg) {
  LooseBody loose;
  loose.id = participant.id;
  loose.model = participant.model;
  if (is_box(participant)) loose.box_size_m = box_size_m(participant);
  loose.paint = participant.paint;
  loose.lamps = participant.lamps;
  for (const Lamp lamp : {Lamp::indicator_left, Lamp::indicator_right}) loose.lamps.set(lamp, false);
  loose.front_steer_rad = participant.front_steer_rad;
  loose.wheel_spin_rad = participant.wheel_spin_rad;
  loose.body = impact_side(participant, mass_kg).body;
  if (!std::isfinite(mass_kg)) {
    loose.body.velocity_mps = Vec2(0.0);
    loose.body.yaw_rate_radps = 0.0;
  }
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
  if (is_box(participant))
    set_box_size(loose.box_size_m, participant);
  else
    participant.lamps.set(Lamp::brake, true);
  participant.front_steer_rad = loose.front_steer_rad;
  participant.wheel_spin_rad = loose.wheel_spin_rad;
  RigidTransform& place = participant.world_from_vehicle;
  place.orientation = orientation_on(loose.up, loose.body.heading_rad);
  const Vec3 arm_m = arm_of(shape_of(loose), place.orientation);
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

void push(const Vec3& impulse_ns, LooseBody& loose) {
  const Vec2 change_mps = Vec2(impulse_ns) / loose.body.mass_kg;
  loose.body.velocity_mps += change_mps;
  loose.acceleration_mps2 += change_mps / tick_s;
}

std::array<Vec3, vehicle::wheel_count> feet_m(const LooseBody& loose) {
  constexpr double inwards = 0.4;  // Of a box's length and width, from the middle: its bottom carries all over.
  const VehicleModel shape = shape_of(loose);
  const bool box = shape.kind == ParticipantKind::object;
  const double front_m = box ? inwards * shape.length_m : shape.wheelbase_m, rear_m = box ? -front_m : 0.0,
               half_m = box ? inwards * shape.width_m : 0.5 * shape.track_m;
  return {Vec3(front_m, half_m, shape.wheel_radius_m), Vec3(front_m, -half_m, shape.wheel_radius_m),
          Vec3(rear_m, half_m, shape.wheel_radius_m), Vec3(rear_m, -half_m, shape.wheel_radius_m)};
}

vehicle::LockedWheels locked_wheels(const LooseBody& loose, const std::array<double, vehicle::wheel_count>& friction) {
  // Wood, plastic and steel on dry asphalt of 0.9: about 0.5.
  constexpr double box_share = 0.55;
  const VehicleModel shape = shape_of(loose);
  const bool box = shape.kind == ParticipantKind::object;
  const auto feet = feet_m(loose);
  const double wheelbase_m = std::max(shape.wheelbase_m, 0.1);
  const double front_share = box ? 0.5 : std::clamp(shape.centre_x_m() / wheelbase_m, 0.1, 0.9);
  vehicle::LockedWheels wheels;
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    wheels[i].arm_m = Vec2(feet[i]) - Vec2(shape.centre_x_m(), 0.0);
    wheels[i].load_share = 0.5 * (i < 2 ? front_share : 1.0 - front_share);
    wheels[i].friction = (box ? box_share : vehicle::locked_share) * friction[i];
  }
  return wheels;
}

}  // namespace septet::simulation
