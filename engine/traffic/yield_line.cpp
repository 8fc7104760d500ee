#include "engine/traffic/yield_line.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <tuple>

#include <glm/geometric.hpp>

#include "engine/road/lane_links.hpp"
#include "engine/world/people.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::traffic {
namespace {

using Kind = YieldLine::Kind;

constexpr double before_crossing_m = 1.0, stop_line_near_m = 20.0;
constexpr double over_crossing_m = 7.0, into_junction_m = 14.0;
/// Distance of the middle of a walker, of a vehicle, from the middle of the path when they meet.
constexpr double walker_reach_m = 1.6, vehicle_reach_m = 2.4;
constexpr double usual_walk_mps = 1.3;
constexpr double step_s = 0.1, same_way_cos = 0.77, least_mps = 0.3;

/// Station at which a light's traffic stops.
double stop_line_s(const road::Road& road, const road::Signal& light, bool along) {
  double nearest_m = stop_line_near_m, found = light.s_m;
  for (const road::Signal& signal : road.signals) {
    if (signal.type != "294" || applies_along_s(road, signal) != along) continue;
    const double before_m = along ? light.s_m - signal.s_m : signal.s_m - light.s_m;
    if (before_m < 0.0 || before_m > nearest_m) continue;
    nearest_m = before_m;
    found = signal.s_m;
  }
  return found;
}

bool is_walker(const Participant& participant) {
  const ParticipantKind kind = vehicle_models()[participant.model].kind;
  return kind == ParticipantKind::pedestrian || kind == ParticipantKind::bicycle;
}

double arrival_s(const Participant& other, const Vec2& velocity, std::span<const Vec2> way, double reach_m) {
  const Vec2 from(other.world_from_vehicle.position_m);
  const double turns_radps = other.angular_velocity_radps.z;
  const Vec2 left(-velocity.y, velocity.x);
  for (double t = 0.0; t < conflict_horizon_s; t += step_s) {
    const double angle = turns_radps * t;
    const double along = std::abs(turns_radps) < 1e-3 ? t : std::sin(angle) / turns_radps;
    const double across = std::abs(turns_radps) < 1e-3 ? 0.0 : (1.0 - std::cos(angle)) / turns_radps;
    const Vec2 at = from + along * velocity + across * left;
    if (std::ranges::any_of(way, [&](const Vec2& point) { return glm::distance(point, at) < reach_m; })) return t;
  }
  return conflict_horizon_s;
}

}  // namespace

bool applies_along_s(const road::Road& road, const road::Signal& signal) {
  if (signal.orientation != road::Orientation::both) return signal.orientation == road::Orientation::along;
  return (signal.t_m <= 0.0) == (road.rule == road::TrafficRule::right_hand);
}

std::vector<YieldLine> yield_lines(const road::RoadNetwork& network) {
  std::vector<YieldLine> lines;
  for (road::RoadIndex index = 0; index < network.roads.size(); ++index) {
    const road::Road& road = network.roads[index];
    const std::size_t first = lines.size();
    for (const road::Signal& signal : road.signals) {
      const bool along = applies_along_s(road, signal);
      if (signal.is_vehicle_light())
        lines.push_back({Kind::light, index, along, stop_line_s(road, signal, along), signal.s_m});
      if (signal.type == "205" || signal.type == "206")
        lines.push_back({Kind::give_way, index, along, signal.s_m, signal.s_m});
    }
    for (const road::RoadObject& object : road.objects) {
      if (object.type != "crosswalk") continue;
      const double half_m = 0.5 * object.length_m + before_crossing_m;
      for (const bool along : {true, false}) {
        const double s = std::clamp(object.s_m + (along ? -half_m : half_m), 0.0, road.length_m);
        lines.push_back({Kind::crossing, index, along, s, object.s_m});
      }
    }
    // Heads at one line are one light.
    const auto order = [](const YieldLine& line) { return std::tuple(line.s_m, line.along_s, line.kind); };
    const auto begin = lines.begin() + static_cast<std::ptrdiff_t>(first);
    std::ranges::stable_sort(begin, lines.end(), {}, order);
    const auto same = [&](const YieldLine& a, const YieldLine& b) { return order(a) == order(b); };
    lines.erase(std::unique(begin, lines.end(), same),
                lines.end());  // Not std::ranges::unique: clang 14 cannot compile it.
  }
  return lines;
}

std::vector<Vec2> way_beyond(const road::RoadNetwork& network, Kind kind, const road::LanePosition& at_line) {
  std::vector<Vec2> way;
  const double length_m = kind == Kind::crossing ? over_crossing_m : into_junction_m;
  for (double ahead_m = 1.0; ahead_m <= length_m; ahead_m += 1.0) {
    const road::Advanced there = road::advance(network, at_line, ahead_m);
    if (there.remaining_m > 0.0) break;
    way.emplace_back(road::evaluate_lane(network, there.position).road.position_m);
  }
  return way;
}

std::optional<Conflict> first_conflict(Kind kind, std::span<const Vec2> way, std::span<const Participant> participants,
                                       const Participant& self) {
  if (kind == Kind::light || way.empty()) return std::nullopt;
  const Vec3 ahead = self.world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0);
  std::optional<Conflict> first;
  for (const Participant& other : participants) {
    if (other.id == self.id || is_walker(other) != (kind == Kind::crossing)) continue;
    if (vehicle_models()[other.model].kind == ParticipantKind::object) continue;
    const double far_m = glm::distance(way.front(), Vec2(other.world_from_vehicle.position_m));
    Vec2 velocity(other.velocity_mps);
    if (is_person_of_swarm(other.id)) {
      // Most walk along; one who would cross and waits counts as one who goes.
      if (!other.lamps.has(Lamp::signal_green)) continue;
      if (glm::length(velocity) < usual_walk_mps)
        velocity = usual_walk_mps * Vec2(other.world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0));
    }
    const double mps = glm::length(velocity);
    if (far_m > 20.0 + mps * conflict_horizon_s || mps < least_mps) continue;
    const Vec3 goes = other.world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0);
    if (kind == Kind::give_way && glm::dot(Vec2(goes), Vec2(ahead)) > same_way_cos) continue;
    const double in_s = arrival_s(other, velocity, way, kind == Kind::crossing ? walker_reach_m : vehicle_reach_m);
    if (in_s < conflict_horizon_s && (!first || in_s < first->in_s)) first = Conflict{other.id, in_s};
  }
  return first;
}

}  // namespace septet::traffic
