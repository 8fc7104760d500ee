#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/road/lane_geometry.hpp"
#include "engine/traffic/traffic_parts.hpp"
#include "engine/world/indicator.hpp"

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

/// The angle of this tangent: by its series where that is good to 1e-12, as on all but tight bends.
double small_angle_rad(double tangent) {
  const double q = tangent * tangent;
  if (q > 2e-4) return std::atan(tangent);
  return tangent * (1.0 - q * (1.0 / 3 - q * (1.0 / 5 - q * (1.0 / 7))));
}

/// q turned further about its own z axis, by twice the angle of (cos, sin). Number by number into the participant: an
/// object in between would be written in halves and read whole, for which the processor waits.
void turn_about_up(const Quat& q, const Vec2& half, Quat& turned) {
  turned.w = q.w * half.x - q.z * half.y;
  turned.x = q.x * half.x + q.y * half.y;
  turned.y = q.y * half.x - q.x * half.y;
  turned.z = q.z * half.x + q.w * half.y;
}

/// Begins to fetch what `describe` will read of the road for this vehicle: the tables are larger
/// than the nearest cache, and vehicles stand in them without an order.
void prefetch(const CorridorTraffic& traffic, std::size_t i) {
  static_assert(LineTable::step_m == LaneTable::knot_step_m);
  const auto k = static_cast<std::size_t>(std::max(traffic.x_m[i], 0.0) / LineTable::step_m);
  if (k >= traffic.line.cubics.size()) return;
  __builtin_prefetch(&traffic.line.pieces[k]);
  for (const auto& power : traffic.line.cubics[k]) __builtin_prefetch(power.data());
  __builtin_prefetch(&traffic.table.centres[static_cast<std::size_t>(traffic.lane[i])].knots[k]);
}

/// Fills in a blank participant; its origin is at `x`.
void describe(const CorridorTraffic& traffic, std::size_t i, const VehicleModel& model, double x,
              const road::RoadNetwork& network, double time_s, Participant& participant) {
  const auto [piece, s, line] = line_at(network, traffic.corridor, traffic.line, x);
  const double direction = piece.along_s ? 1.0 : -1.0;

  LaneCentre centre = lane_centre(network, traffic.table, piece, x, traffic.lane[i]);
  double across = 0.0;
  LateralBlend blend;
  if (traffic.lane[i] != traffic.from_lane[i]) {
    const auto from = lane_centre(network, traffic.table, piece, x, traffic.from_lane[i]);
    blend = lateral_blend(traffic.change_s[i], traffic.driver[i].lane_change.duration_s);
    across = centre.t_m - from.t_m;
    centre.t_m = glm::mix(from.t_m, centre.t_m, blend.value);
    centre.slope = glm::mix(from.slope, centre.slope, blend.value);
  }
  const double t = centre.t_m + direction * traffic.aside_m[i];
  const Quat& world_from_line = line.world_from_line.orientation;
  const glm::dmat3 axes = glm::mat3_cast(world_from_line);
  const Vec3 &forward = axes[0], &left = axes[1], &up = axes[2];
  Vec3& position_m = participant.world_from_vehicle.position_m;
  const road::Road& road = network.roads[piece.road];
  const double above = road.flat ? 0.0 : road::surface_offset_m(road, s, t);
  const Vec3& middle = line.world_from_line.position_m;
  position_m.x = middle.x + t * left.x + above * up.x;
  position_m.y = middle.y + t * left.y + above * up.y;
  position_m.z = middle.z + t * left.z + above * up.z;
  const double v = traffic.speed_mps[i];
  // Sideways speed in the frame of travel, positive to the left.
  const double lateral_mps =
      direction * across * blend.rate + centre.slope * v + traffic.aside_mps[i];
  // The vehicle points where it goes; against s it is turned by half a turn as well.
  Vec2 turned = direction > 0.0 ? Vec2(1.0, 0.0) : Vec2(0.0, 1.0);
  if (lateral_mps != 0.0) {
    const double ahead = std::max(v, 1.0);
    const double way = std::sqrt(ahead * ahead + lateral_mps * lateral_mps);
    turned = half_turn(direction * ahead / way, direction * lateral_mps / way);
  }

  participant.id = traffic.id[i];
  participant.model = traffic.model[i];
  participant.paint = traffic.paint[i];
  turn_about_up(world_from_line, turned, participant.world_from_vehicle.orientation);
  const double curvature_per_m = line.curvature_per_m / (1.0 - line.curvature_per_m * t);
  const double yaw_rate = direction * curvature_per_m * v;
  const auto along_and_across = [&](double along, double aside, Vec3& out) {
    out.x = direction * (forward.x * along + left.x * aside);
    out.y = direction * (forward.y * along + left.y * aside);
    out.z = direction * (forward.z * along + left.z * aside);
  };
  along_and_across(v, lateral_mps, participant.velocity_mps);
  along_and_across(traffic.acceleration_mps2[i],
                   v * yaw_rate + direction * across * blend.acceleration,
                   participant.acceleration_mps2);
  participant.angular_velocity_radps.z = yaw_rate;
  const double bend = model.wheelbase_m * direction * curvature_per_m;
  participant.front_steer_rad = small_angle_rad(bend);
  // Rolling along the corridor is all that turns the wheels.
  constexpr double turn_rad = 2.0 * std::numbers::pi;
  const double radps_per_mps = 1.0 / model.wheel_radius_m;
  const double turns = std::max(traffic.x_m[i], 0.0) * radps_per_mps * (1.0 / turn_rad);
  participant.wheel_spin_rad = (turns - std::floor(turns)) * turn_rad;
  participant.wheel_spin_radps = v * radps_per_mps;
  participant.lamps.set(Lamp::low_beam, true);
  participant.lamps.set(Lamp::brake, traffic.acceleration_mps2[i] < -0.7);
  participant.lamps.set(Lamp::beacon, traffic.emergency[i] != 0);
  participant.lamps.set(Lamp::siren, traffic.emergency[i] != 0);
  const double side = indicated_side(traffic, i, direction * across);
  if (side != 0.0 && indicator_is_lit(time_s, traffic.id[i]))
    participant.lamps.set(side > 0.0 ? Lamp::indicator_left : Lamp::indicator_right, true);
}

}  // namespace

void append_participants(const TrafficState& state, const road::RoadNetwork& network,
                         std::vector<Participant>& participants) {
  const auto models = vehicle_models();
  for (const auto& traffic : state.corridors)
    for (std::size_t i = 0; i < traffic.size(); ++i) {
      prefetch(traffic, std::min(i + 2, traffic.size() - 1));
      if (traffic.lane[i] == 0) continue;
      const VehicleModel& model = models[traffic.model[i]];
      // The vehicle frame's origin is below the rear axle.
      const double x = traffic.x_m[i] - model.front_m();
      if (!traffic.corridor.closed && (x < 0.0 || x > traffic.corridor.length_m)) continue;
      describe(traffic, i, model, wrap_x(traffic.corridor, x), network, state.time_s,
               participants.emplace_back());
    }
}

}  // namespace septet::traffic
