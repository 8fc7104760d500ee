#include <algorithm>
#include <cmath>

#include "engine/road/road_locate.hpp"
#include "engine/world/indicator.hpp"
#include "sim-server/sumo/sumo_traffic.hpp"

namespace septet::server {
namespace {

constexpr double turn = 6.283185307179586477;
constexpr double drift_time_s = 0.3;
constexpr double slip_time_s = 2.0, most_slip_m = 6.0;
/// At walking pace SUMO moves vehicles sideways without driving: they turn no further than at this speed.
constexpr double least_way_mps = 8.0;
constexpr double brake_lamp_mps2 = 0.7;

}  // namespace

void tell_sumo_motion(const Participant& before, double gained_mps, Participant& now) {
  constexpr double most_off_mps = 20.0;
  const Vec3 mean = (now.world_from_vehicle.position_m - before.world_from_vehicle.position_m) / sumo_step_s;
  if (glm::length(mean - now.velocity_mps) > most_off_mps) return;  // Set somewhere else.
  const Vec3 forward = now.world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0);
  now.velocity_mps = mean + 0.5 * gained_mps * forward;
  const double turned = std::remainder(
      heading_rad(now.world_from_vehicle.orientation) - heading_rad(before.world_from_vehicle.orientation), turn);
  const double speed = glm::dot(now.velocity_mps, forward), yaw_rate = turned / sumo_step_s;
  const VehicleModel& model = vehicle_models()[now.model];
  now.acceleration_mps2 = gained_mps / sumo_step_s * forward +
                          speed * yaw_rate * (now.world_from_vehicle.orientation * Vec3(0.0, 1.0, 0.0));
  now.angular_velocity_radps = Vec3(0.0, 0.0, yaw_rate);
  if (speed > 1.0) now.front_steer_rad = std::atan(model.wheelbase_m * yaw_rate / speed);
  now.wheel_spin_radps = speed / model.wheel_radius_m;
}

std::optional<Participant> SumoTraffic::participant_of(Member& member, const SumoVehicle& vehicle, bool is_new) const {
  const VehicleModel& model = vehicle_models()[member.model];
  const auto front = road::locate(roads_, vehicle.front_m, member.place ? &*member.place : nullptr);
  if (!front) return std::nullopt;
  const auto line = road::evaluate(roads_, front->position);
  const double direction = std::cos(vehicle.heading_rad - line.heading_rad) >= 0.0 ? 1.0 : -1.0;
  const double driven = 0.5 * (member.speed_mps + vehicle.speed_mps) * sumo_step_s;
  if (is_new) {
    member.lateral_mps = member.slip_m = 0.0;
  } else if (member.place && member.place->road == front->position.road) {
    const double rate = direction * (front->position.t_m - member.place->t_m) / sumo_step_s;
    member.lateral_mps += (rate - member.lateral_mps) * sumo_step_s / drift_time_s;
    // All lanes of an edge are equally long to SUMO: in a bend a lane change shifts a vehicle forwards or back. The
    // shift is absorbed and released slowly.
    const double slip = direction * (front->position.s_m - member.place->s_m) * line.stretch - driven;
    member.slip_m = std::abs(slip) < most_slip_m ? (member.slip_m - slip) * (1.0 - sumo_step_s / slip_time_s) : 0.0;
  }
  if (!is_new) member.rolled_m += driven;
  member.place = front->position;
  member.speed_mps = vehicle.speed_mps;

  const double heading = line.heading_rad + (direction > 0.0 ? 0.0 : 0.5 * turn) +
                         std::atan2(member.lateral_mps, std::max(vehicle.speed_mps, least_way_mps));
  const Vec2 rear = vehicle.front_m + (member.slip_m - model.front_m()) * Vec2(std::cos(heading), std::sin(heading));
  const double speed = vehicle.speed_mps - member.slip_m / slip_time_s;
  const auto place = road::locate(roads_, rear, &*member.place);
  if (!place) return std::nullopt;
  const auto point = road::evaluate(roads_, place->position);
  const RigidTransform world_from_line = road::world_from_road(point);
  const Vec3 forward = world_from_line.orientation * Vec3(direction, 0.0, 0.0);
  const Vec3 left = world_from_line.orientation * Vec3(0.0, direction, 0.0);
  const double yaw_rate = direction * point.curvature_per_m * speed;

  Participant participant;
  participant.id = member.id;
  participant.model = member.model;
  participant.paint = member.paint;
  participant.world_from_vehicle = {
      point.position_m, world_from_line.orientation * glm::angleAxis(heading - point.heading_rad, Vec3(0, 0, 1))};
  participant.velocity_mps = forward * speed + left * member.lateral_mps;
  participant.acceleration_mps2 = forward * vehicle.acceleration_mps2 + left * (speed * yaw_rate);
  participant.angular_velocity_radps = Vec3(0.0, 0.0, yaw_rate);
  participant.front_steer_rad = std::atan(model.wheelbase_m * direction * point.curvature_per_m);
  participant.wheel_spin_rad = std::fmod(member.rolled_m / model.wheel_radius_m, turn);
  participant.wheel_spin_radps = speed / model.wheel_radius_m;
  participant.lamps.set(Lamp::low_beam, true);
  // At speed SUMO lights the brake lamps only from about 5 m/s²; drivers behind need to see less.
  participant.lamps.set(
      Lamp::brake, (vehicle.signals & sumo_signal::brake_light) != 0 || vehicle.acceleration_mps2 < -brake_lamp_mps2);
  // True while the indicator is on; the display makes it blink.
  participant.lamps.set(Lamp::indicator_left, (vehicle.signals & sumo_signal::blinker_left) != 0);
  participant.lamps.set(Lamp::indicator_right, (vehicle.signals & sumo_signal::blinker_right) != 0);
  return participant;
}

Participant SumoTraffic::shown(const Participant& participant) const {
  Participant result = participant;
  const bool lit = indicator_is_lit(time_s_, participant.id);
  for (const Lamp lamp : {Lamp::indicator_left, Lamp::indicator_right})
    result.lamps.set(lamp, lit && participant.lamps.has(lamp));
  return result;
}

}  // namespace septet::server
