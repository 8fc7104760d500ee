#include <cmath>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/lane_links.hpp"
#include "engine/traffic/traffic_parts.hpp"

namespace septet::traffic {
namespace {

/// Positive: to the left. A lane change is indicated until its end, making way until the vehicle is
/// there.
double indicated_side(const CorridorTraffic& traffic, std::size_t i, double across_m) {
  if (traffic.emergency[i] != 0) return 0.0;
  if (traffic.lane[i] != traffic.from_lane[i]) return across_m;
  const double away = traffic.aside_target_m[i] - traffic.aside_m[i];
  return std::abs(away) > 0.15 ? away : 0.0;
}

Participant participant_of(const CorridorTraffic& traffic, std::size_t i,
                           const road::RoadNetwork& network, double time_s) {
  const VehicleModel& model = vehicle_models()[traffic.model[i]];
  // The vehicle frame's origin is below the rear axle.
  const double rear_axle_x = traffic.x_m[i] - model.front_m();
  const auto position =
      position_at(traffic.corridor, wrap_x(traffic.corridor, rear_axle_x), traffic.lane[i]);
  const road::Road& road = network.roads[position.road];
  const auto& section = road::section_at(road, position.s_m);
  const CorridorPiece& piece = piece_at(traffic.corridor, wrap_x(traffic.corridor, rear_axle_x));
  const auto borders_of = [&](int lane) {
    const int id = piece.side * lane;
    return section.has_lane(id)
               ? road::lane_borders(road, section, id, position.s_m)
               : road::lane_borders(road, section,
                                    piece.side > 0 ? section.left_count : -section.right_count,
                                    position.s_m);
  };
  const auto to = borders_of(traffic.lane[i]), from = borders_of(traffic.from_lane[i]);
  const bool changing = traffic.lane[i] != traffic.from_lane[i];
  const LateralBlend blend =
      changing ? lateral_blend(traffic.change_s[i], traffic.driver[i].lane_change.duration_s)
               : LateralBlend{};
  const double direction = piece.along_s ? 1.0 : -1.0;
  const double t =
      glm::mix(from.centre_t_m(), to.centre_t_m(), blend.value) + direction * traffic.aside_m[i];
  const double across = to.centre_t_m() - from.centre_t_m();
  const double slope = glm::mix(from.centre_slope(), to.centre_slope(), blend.value);

  const road::RoadPoint point = road::evaluate(network, {position.road, position.s_m, t});
  const double v = traffic.speed_mps[i];
  // Sideways speed in the frame of travel, positive to the left.
  const double lateral_mps = direction * across * blend.rate + slope * v + traffic.aside_mps[i];
  const RigidTransform world_from_line = road::world_from_road(point);
  const Quat turned = glm::angleAxis(
      (direction > 0.0 ? 0.0 : std::acos(-1.0)) + std::atan2(lateral_mps, std::max(v, 1.0)),
      Vec3(0, 0, 1));

  Participant participant;
  participant.id = traffic.id[i];
  participant.model = traffic.model[i];
  participant.paint = traffic.paint[i];
  participant.world_from_vehicle = {point.position_m, world_from_line.orientation * turned};
  const Vec3 forward = world_from_line.orientation * Vec3(direction, 0.0, 0.0);
  const Vec3 left = world_from_line.orientation * Vec3(0.0, direction, 0.0);
  const double yaw_rate = direction * point.curvature_per_m * v;
  participant.velocity_mps = forward * v + left * lateral_mps;
  participant.acceleration_mps2 = forward * traffic.acceleration_mps2[i] +
                                  left * (v * yaw_rate + direction * across * blend.acceleration);
  participant.angular_velocity_radps = Vec3(0.0, 0.0, yaw_rate);
  participant.front_steer_rad = std::atan(model.wheelbase_m * direction * point.curvature_per_m);
  // Rolling along the corridor is all that turns the wheels.
  participant.wheel_spin_rad =
      std::fmod(std::max(traffic.x_m[i], 0.0) / model.wheel_radius_m, 2.0 * std::acos(-1.0));
  participant.wheel_spin_radps = v / model.wheel_radius_m;
  participant.lamps.set(Lamp::low_beam, true);
  participant.lamps.set(Lamp::brake, traffic.acceleration_mps2[i] < -0.7);
  participant.lamps.set(Lamp::beacon, traffic.emergency[i] != 0);
  participant.lamps.set(Lamp::siren, traffic.emergency[i] != 0);
  const double side = indicated_side(traffic, i, direction * across);
  if (side != 0.0 && std::fmod(time_s + 0.13 * static_cast<double>(traffic.id[i] % 7), 0.7) < 0.37)
    participant.lamps.set(side > 0.0 ? Lamp::indicator_left : Lamp::indicator_right, true);
  return participant;
}

}  // namespace

void append_participants(const TrafficState& state, const road::RoadNetwork& network,
                         std::vector<Participant>& participants) {
  for (const auto& traffic : state.corridors)
    for (std::size_t i = 0; i < traffic.size(); ++i) {
      if (traffic.lane[i] == 0) continue;
      const double rear_axle_x = traffic.x_m[i] - vehicle_models()[traffic.model[i]].front_m();
      if (!traffic.corridor.closed &&
          (rear_axle_x < 0.0 || traffic.x_m[i] > traffic.corridor.length_m))
        continue;
      participants.push_back(participant_of(traffic, i, network, state.time_s));
    }
}

}  // namespace septet::traffic
