#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/road/lane_geometry.hpp"
#include "engine/traffic/looks.hpp"
#include "engine/traffic/traffic_stages.hpp"
#include "engine/world/indicator.hpp"

namespace septet::traffic {
namespace {

/// Positive: to the left. A lane change is indicated until its end, making way until the vehicle is there.
double indicated_side(const CorridorTraffic& traffic, std::size_t i, double across_m) {
  if (traffic.emergency[i] != 0) return 0.0;
  if (changes_lane(traffic, i)) return across_m;
  const double away = traffic.aside_target_m[i] - traffic.aside_m[i];
  return std::abs(away) > 0.15 ? away : 0.0;
}

/// The angle of this tangent: by its series where that is good to 1e-12, as on all but tight bends.
double small_angle_rad(double tangent) {
  const double q = tangent * tangent;
  if (q > 2e-4) return std::atan(tangent);
  return tangent * (1.0 - q * (1.0 / 3 - q * (1.0 / 5 - q * (1.0 / 7))));
}

/// Rotates q further about its own z axis, by twice the angle of (cos, sin). Number by number into the participant: an
/// object in between would be written in halves and read whole, for which the processor waits.
void turn_about_up(const Quat& q, const Vec2& half, Quat& turned) {
  turned.w = q.w * half.x - q.z * half.y;
  turned.x = q.x * half.x + q.y * half.y;
  turned.y = q.y * half.x - q.x * half.y;
  turned.z = q.z * half.x + q.w * half.y;
}

/// Prefetches the road data that `describe` will read for this vehicle: the tables are larger than the nearest cache,
/// and vehicles stand in them without an order.
void prefetch(const CorridorTraffic& traffic, std::size_t i) {
  static_assert(LineTable::step_m == LaneTable::knot_step_m);
  const auto k = static_cast<std::size_t>(std::max(traffic.x_m[i], 0.0) / LineTable::step_m);
  if (k >= traffic.line.cubics.size()) return;
  __builtin_prefetch(&traffic.line.pieces[k]);
  for (const auto& power : traffic.line.cubics[k]) __builtin_prefetch(power.data());
  __builtin_prefetch(&traffic.table.centres[static_cast<std::size_t>(traffic.lane[i])].knots[k]);
}

/// Fills in a blank participant; its origin is at `x`. Its velocities are the exact derivatives of its positions.
void describe(const CorridorTraffic& traffic, std::size_t i, const VehicleModel& model, double x,
              const road::RoadNetwork& network, double time_s, Participant& participant) {
  const PathPoint path = path_at(network, traffic, i, x);
  const auto& [piece, s, line] = path.at;
  const double t = path.t_m, direction = path.direction, slope = path.slope;
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
  // The vehicle points along its motion; against s it is turned by half a turn as well.
  Vec2 turned = direction > 0.0 ? Vec2(1.0, 0.0) : Vec2(0.0, 1.0);
  double pointed = 1.0;  // Cosine of the angle between the path and the line of constant t.
  if (slope != 0.0) {
    pointed = 1.0 / std::sqrt(1.0 + slope * slope);
    turned = half_turn(direction * pointed, direction * slope * pointed);
  }

  participant.id = traffic.id[i];
  participant.model = look_of(traffic.model[i], traffic.id[i]);
  participant.paint = traffic.paint[i];
  turn_about_up(world_from_line, turned, participant.world_from_vehicle.orientation);
  // Turn of the line, and turn of the path against it, by a metre of the line of constant t.
  const double line_turns = direction * line.curvature_per_m / path.tangent.stretch;
  const double path_turns = path.curvature_per_m;
  const double turns_per_m = line_turns + path_turns * pointed * pointed;
  const double a = traffic.acceleration_mps2[i];
  const auto along_and_across = [&](double along, double left_of_it, Vec3& out) {
    out.x = direction * (forward.x * along + left.x * left_of_it);
    out.y = direction * (forward.y * along + left.y * left_of_it);
    out.z = direction * (forward.z * along + left.z * left_of_it);
  };
  along_and_across(v, v * slope, participant.velocity_mps);
  along_and_across(a - v * v * slope * line_turns, a * slope + v * v * (line_turns + path_turns),
                   participant.acceleration_mps2);
  // Beside the reference line of a bend that climbs, and where the road's tilt changes, the slope differs.
  if (path.tangent.up != 0.0) {
    const double climbs = path.tangent.up / path.tangent.stretch - forward.z;
    participant.velocity_mps.z += direction * v * climbs;
    const double level = std::sqrt(1.0 - forward.z * forward.z);
    if (level > 0.0) {
      const double shorter = path.tangent.forward / path.tangent.stretch / level - 1.0;
      participant.velocity_mps.x += direction * v * shorter * forward.x;
      participant.velocity_mps.y += direction * v * shorter * forward.y;
    }
  }
  participant.angular_velocity_radps.z = turns_per_m * v;
  participant.front_steer_rad = small_angle_rad(model.wheelbase_m * turns_per_m * pointed);
  // The wheels turn by rolling along its path alone.
  constexpr double turn_rad = 2.0 * std::numbers::pi;
  const double radps_per_mps = 1.0 / model.wheel_radius_m;
  const double turns = std::max(traffic.rolled_m[i], 0.0) * radps_per_mps * (1.0 / turn_rad);
  participant.wheel_spin_rad = (turns - std::floor(turns)) * turn_rad;
  participant.wheel_spin_radps = v * radps_per_mps;
  participant.lamps.set(Lamp::low_beam, true);
  participant.lamps.set(Lamp::brake, traffic.acceleration_mps2[i] < -0.7);
  participant.lamps.set(Lamp::beacon, traffic.emergency[i] != 0);
  participant.lamps.set(Lamp::siren, traffic.emergency[i] != 0);
  const double side = indicated_side(traffic, i, -traffic.change_offset_m[i]);
  if (side != 0.0 && indicator_is_lit(time_s, traffic.id[i]))
    participant.lamps.set(side > 0.0 ? Lamp::indicator_left : Lamp::indicator_right, true);
}

}  // namespace

PathPoint path_at(const road::RoadNetwork& network, const CorridorTraffic& traffic, std::size_t i, double x) {
  PathPoint path{.at = line_at(network, traffic.corridor, traffic.line, x)};
  const CorridorPiece& piece = path.at.piece;
  path.direction = piece.along_s ? 1.0 : -1.0;
  const LaneCentre centre = lane_centre(network, traffic.table, piece, x, traffic.lane[i]);
  const Lateral aside = lateral(traffic, i);
  path.t_m = centre.t_m + path.direction * aside.offset_m;
  path.tangent = tangent_at(network.roads[piece.road], path.at.line, path.at.s_m, path.t_m);
  const double by_way = 1.0 / path.tangent.stretch;
  path.slope = centre.slope * by_way + aside.slope;
  path.curvature_per_m = path.direction * centre.slope_by_s * by_way * by_way + aside.curvature_per_m;
  return path;
}

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
      describe(traffic, i, model, wrap_x(traffic.corridor, x), network, state.time_s, participants.emplace_back());
    }
}

}  // namespace septet::traffic
