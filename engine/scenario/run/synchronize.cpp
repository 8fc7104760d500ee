#include "engine/scenario/run/synchronize.hpp"

#include <algorithm>
#include <cmath>

#include "engine/scenario/run/entity_distance.hpp"

namespace septet::scenario {
namespace {

constexpr double at_rest_mps = 1e-3;

/// Distance ahead to a target along the roads, else in a straight line; negative behind it.
double way_m(const road::RoadNetwork& network, const EntityState& entity, const Placement& target) {
  if (entity.on_road && target.on_road) {
    const double along = road_distance_m(network, entity.lane, entity.along_s, target.lane);
    if (std::isfinite(along)) return along;
  }
  const Vec3 apart = target.pose.position_m - entity.world_from_entity.position_m;
  const Vec3 forward = entity.world_from_entity.orientation * Vec3(1.0, 0.0, 0.0);
  return std::copysign(glm::length(apart), glm::dot(apart, forward));
}

std::optional<double> final_mps(const SynchronizeAction& what, double master_mps) {
  using Kind = SynchronizeAction::FinalSpeed;
  if (what.final_speed == Kind::any) return std::nullopt;
  const double speed = what.final_speed == Kind::master_plus    ? master_mps + what.final_value
                       : what.final_speed == Kind::master_times ? master_mps * what.final_value
                                                                : what.final_value;
  return std::max(0.0, speed);
}

}  // namespace

std::optional<double> final_mps(const Meeting& meeting, const ScenarioState& state) {
  return final_mps(meeting.what, state.entities[meeting.what.master].speed_mps);
}

double next_meeting_mps(const Rendezvous& left, double v, double dt_s) {
  const double s = left.way_m, t = left.time_s;
  if (t <= dt_s) return left.final_mps.value_or(std::max(0.0, v));
  if (!left.final_mps) return std::max(0.0, v + 2.0 * (s / t - v) / t * dt_s);
  const double end = *left.final_mps;
  // Both changes with the acceleration ±a: 2 t w² − 4 s w + 2 s (v + end) − t (v² + end²) = 0 for the speed w between
  // them.
  const double root = std::sqrt(std::max(0.0, s * s - 0.5 * t * (2.0 * s * (v + end) - t * (v * v + end * end))));
  const double sign = s >= 0.5 * t * (v + end) ? 1.0 : -1.0;
  const double w = (s + sign * root) / t;
  // An entity that would have to go back stops and waits instead: one braking and one acceleration of the same strength
  // fill the distance.
  if (w < 0.0) return s > 0.0 ? std::max(0.0, v - (v * v + end * end) / (2.0 * s) * dt_s) : end;
  const double a = (2.0 * w - v - end) / t;
  const double first_s = a != 0.0 ? (w - v) / a : 0.0;
  const double next = dt_s <= first_s ? v + a * dt_s : w - a * (dt_s - first_s);
  return std::max(0.0, next);
}

std::optional<Meeting> plan_meeting(const road::RoadNetwork& network, const ScenarioState& state,
                                    const SynchronizeAction& what) {
  const auto own = resolve_position(network, state, what.target);
  const auto master = resolve_position(network, state, what.master_target);
  if (!own || !master || !state.entities[what.master].active) return std::nullopt;
  return Meeting{*own, *master, what};
}

std::optional<Rendezvous> left_of(const road::RoadNetwork& network, const ScenarioState& state, const Meeting& meeting,
                                  const EntityState& actor, double dt_s) {
  const SynchronizeAction& what = meeting.what;
  const EntityState& master = state.entities[what.master];
  double master_way = way_m(network, master, meeting.master_target);
  Rendezvous left{way_m(network, actor, meeting.target), 0.0, final_mps(what, master.speed_mps)};
  // An entity within the tolerance has arrived.
  left.way_m -= what.tolerance_m;
  master_way -= what.master_tolerance_m;
  if (left.way_m <= 0.5 * actor.speed_mps * dt_s || master_way <= 0.5 * master.speed_mps * dt_s) return std::nullopt;
  left.time_s = master_way / std::max(master.speed_mps, at_rest_mps);
  if (!left.final_mps) return left;
  // Distance already driven at the final speed.
  const double v = std::max(*left.final_mps, at_rest_mps);
  const double steady_s = std::max(what.steady_s, what.steady_m / v);
  left.way_m -= steady_s * v;
  left.time_s -= steady_s;
  return left;
}

}  // namespace septet::scenario
