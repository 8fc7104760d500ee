#include "engine/scenario/run/keep_distance.hpp"

#include <algorithm>
#include <cmath>

#include "engine/scenario/run/entity_distance.hpp"
#include "engine/scenario/run/resolve_position.hpp"

namespace septet::scenario {
namespace {

constexpr double natural_radps = 0.63, natural_lateral_radps = 2.0;
constexpr double reserve = 0.8;  ///< Share of the deceleration bound that the approach relies on.

Vec3 driving_axis(const road::RoadNetwork& network, const EntityState& actor, bool lateral) {
  const Vec3 axis = lateral ? Vec3(0.0, 1.0, 0.0) : Vec3(1.0, 0.0, 0.0);
  const Quat facing = actor.on_road ? lane_pose(network, actor.lane, actor.along_s, 0.0, 0.0).orientation
                                    : actor.world_from_entity.orientation;
  return facing * axis;
}

/// Distance of the reference ahead, or to the left.
double reference_m(const road::RoadNetwork& network, const KeepDistanceAction& what, const EntityState& actor,
                   const EntityState& reference) {
  const bool by_road = what.system == CoordinateSystem::road || what.system == CoordinateSystem::lane;
  if (by_road && actor.on_road && reference.on_road) {
    if (!what.lateral)
      return road_distance_m(network, actor.lane, actor.along_s, reference.lane, what.system == CoordinateSystem::lane);
    if (actor.lane.road == reference.lane.road) {
      const double left = lateral_t_m(network, reference.lane) - lateral_t_m(network, actor.lane);
      return actor.along_s ? left : -left;
    }
  }
  const Vec3 apart = reference.world_from_entity.position_m - actor.world_from_entity.position_m;
  if (what.system == CoordinateSystem::world) return what.lateral ? apart.y : apart.x;
  return glm::dot(apart, driving_axis(network, actor, what.lateral));
}

/// Distance between the reference points where the boxes touch.
double boxes_m(const BoundingBox& front, const BoundingBox& back, bool lateral) {
  if (!lateral) return back.front_m() - front.rear_m();
  return back.centre_m.y + 0.5 * back.width_m - (front.centre_m.y - 0.5 * front.width_m);
}

}  // namespace

std::optional<double> way_to_distance_m(const road::RoadNetwork& network, const Scenario& scenario,
                                        const ScenarioState& state, const KeepDistanceAction& what, double side,
                                        EntityIndex actor) {
  const EntityState &own = state.entities[actor], &reference = state.entities[what.reference];
  if (!own.active || !reference.active) return std::nullopt;
  const double there = reference_m(network, what, own, reference);
  if (!std::isfinite(there)) return std::nullopt;
  const bool behind = side > 0.0;  // True if the actor is behind, or to the right.
  double distance = what.distance_m;
  if (what.time_gap_s) distance = *what.time_gap_s * std::abs((behind ? own : reference).speed_mps);
  if (what.freespace) {
    const BoundingBox &box = scenario.entities[actor].box, &other = scenario.entities[what.reference].box;
    distance += behind ? boxes_m(other, box, what.lateral) : boxes_m(box, other, what.lateral);
  }
  return there - side * distance;
}

double side_of_reference(const road::RoadNetwork& network, const Scenario& scenario, const ScenarioState& state,
                         const KeepDistanceAction& what, EntityIndex actor) {
  if (what.reference_side) return *what.reference_side;
  KeepDistanceAction touching = what;
  touching.distance_m = 0.0;
  touching.time_gap_s.reset();
  touching.freespace = false;
  return way_to_distance_m(network, scenario, state, touching, 1.0, actor).value_or(1.0) >= 0.0 ? 1.0 : -1.0;
}

double next_approach_mps(double way_m, double speed_mps, double goal_mps, double acceleration_mps2,
                         const DynamicConstraints& limits, bool lateral, double dt_s) {
  // Sideways "deceleration" ends the movement, to either side.
  const bool mirrored = lateral && way_m < 0.0;
  const double up = mirrored ? limits.max_deceleration_mps2 : limits.max_acceleration_mps2;
  const double down = mirrored ? limits.max_acceleration_mps2 : limits.max_deceleration_mps2;
  const double jerk_up = mirrored ? limits.max_deceleration_rate_mps3 : limits.max_acceleration_rate_mps3;
  const double jerk_down = mirrored ? limits.max_acceleration_rate_mps3 : limits.max_deceleration_rate_mps3;
  // An actor faster than allowed slows down within its bounds, forwards never below a standstill.
  const double highest = std::max(limits.max_speed_mps, speed_mps - down * dt_s);
  const double lowest = lateral ? std::min(-limits.max_speed_mps, speed_mps + up * dt_s) : std::min(0.0, speed_mps);
  const double settling = way_m >= 0.0 ? down : up;
  const double closing = speed_mps - goal_mps;
  double acceleration;
  if (!std::isfinite(settling)) {
    const double wanted = std::clamp(goal_mps + way_m / dt_s, lowest, highest);
    acceleration = (wanted - speed_mps) / dt_s;
  } else {
    // A bound on the change of acceleration leaves a smaller reserve, and a slower approach.
    const double jerk = std::min(jerk_up, jerk_down);
    const double bound = reserve * settling * (std::isfinite(jerk) ? 0.5 : 1.0);
    const double natural = lateral ? natural_lateral_radps : natural_radps;
    const double omega = bound > 0.0 ? std::clamp(0.5 * jerk / bound, 0.3, natural) : natural;
    const double even_mps = bound / omega, even_m = even_mps / omega;  // Nearer than that it is linear.
    const double far = std::abs(way_m);
    const double approach = far <= even_m ? omega * far : std::sqrt(even_mps * even_mps + 2.0 * bound * (far - even_m));
    const double steepness = far <= even_m ? omega : bound / std::max(approach, 1e-9);
    acceleration = omega * (std::copysign(approach, way_m) - closing) - steepness * closing;
  }
  acceleration = std::clamp(acceleration, -down, up);
  acceleration = std::clamp(acceleration, acceleration_mps2 - jerk_down * dt_s, acceleration_mps2 + jerk_up * dt_s);
  return std::clamp(speed_mps + acceleration * dt_s, lowest, std::max(lowest, highest));
}

bool is_at_distance(double way_m, double closing_mps, double dt_s) {
  return std::abs(way_m) <= std::max(0.05, std::abs(closing_mps) * dt_s);
}

}  // namespace septet::scenario
