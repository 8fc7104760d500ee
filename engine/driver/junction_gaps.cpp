#include "engine/driver/junction_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_position.hpp"
#include "engine/world/participant_shape.hpp"

namespace septet::driver {
namespace {

using traffic::LaneGraph;
using traffic::Way;
using traffic::WayConflict;
using traffic::WayIndex;

constexpr double junction_sight_m = 90.0, others_within_m = 110.0;
constexpr double horizon_s = 9.0, hardest_to_wait_mps2 = 6.0;
constexpr double stands_mps = 0.5, sets_off_s = 1.0, drives_off_mps2 = 1.3;
constexpr double between_s = 1.8;  ///< Between one who crosses and the other.
constexpr double stops_before_line_m = 0.8, past_line_m = 1.5;
constexpr double unmarked_mps = 7.0, yielding_mps = 6.0;  ///< Towards a line before which one may have to wait.
constexpr double slows_mps2 = 1.2;
constexpr double patience_s = 12.0;  ///< Then those who stand as well are not waited for any more.
constexpr double room_at_exit_m = 7.0, crawling_mps = 2.0;
constexpr int ways_back = 6;

/// Somebody on a way: his middle, and half his length.
struct OnWay {
  WayIndex way = traffic::no_way;
  double at_m = 0.0, half_m = 0.0, speed_mps = 0.0;
  Lamps lamps;
};

std::vector<OnWay> others_on_ways(const LaneGraph& graph, const road::RoadNetwork& network,
                                  std::span<const Participant> around, ParticipantId self, const Vec3& here_m) {
  std::vector<OnWay> others;
  for (const Participant& other : around) {
    if (other.id == self || glm::distance(other.world_from_vehicle.position_m, here_m) > others_within_m) continue;
    const VehicleModel shape = shape_of(other);
    if (shape.kind == ParticipantKind::pedestrian || shape.kind == ParticipantKind::object) continue;
    const Vec3 heads = other.world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0);
    const Vec2 middle_m(other.world_from_vehicle * Vec3(shape.centre_x_m(), 0.0, 0.0));
    for (const traffic::PlaceOnLane& place :
         traffic::lanes_under(graph, network, middle_m, std::atan2(heads.y, heads.x)))
      others.push_back(
          {place.way, place.at_m, 0.5 * shape.length_m, glm::length(Vec2(other.velocity_mps)), other.lamps});
  }
  return others;
}

/// True if his indicator tells of another way than this one.
bool signals_otherwise(const Lamps& lamps, double turns_rad) {
  constexpr double turning_rad = 0.5;
  const bool left = lamps.has(Lamp::indicator_left), right = lamps.has(Lamp::indicator_right);
  if (left == right) return false;
  return left ? turns_rad < turning_rad : turns_rad > -turning_rad;
}

/// Distance from somebody to a place on a way that he may be coming to; empty: he is not on it, or past it.
std::optional<double> distance_to(const LaneGraph& graph, const OnWay& other, WayIndex way, double at_m) {
  if (other.way == way) return at_m - other.at_m;
  double passed_m = at_m;
  std::vector<WayIndex> front{way};
  for (int k = 0; k < ways_back && passed_m < others_within_m; ++k) {
    std::vector<WayIndex> before;
    double longest_m = 0.0;
    for (const WayIndex index : front)
      for (const WayIndex one : graph.before_of(graph.ways[index])) {
        if (one == other.way) return passed_m + graph.ways[one].length_m - other.at_m;
        before.push_back(one);
        longest_m = std::max(longest_m, graph.ways[one].length_m);
      }
    if (before.empty()) return std::nullopt;
    passed_m += longest_m;
    front = std::move(before);
  }
  return std::nullopt;
}

/// Seconds to drive so far from a speed, speeding up gently to the speed of a turn.
double seconds_for(double metres, double speed_mps) {
  constexpr double turn_mps = 8.0;
  if (metres <= 0.0) return 0.0;
  const double from = std::max(0.0, speed_mps), top = std::max(turn_mps, from);
  const double gain_m = (top * top - from * from) / (2.0 * drives_off_mps2);
  const double moving_s = metres < gain_m
                              ? (std::sqrt(from * from + 2.0 * drives_off_mps2 * metres) - from) / drives_off_mps2
                              : (top - from) / drives_off_mps2 + (metres - gain_m) / top;
  return moving_s + (from < 1.0 ? sets_off_s : 0.0);
}

struct Mine {
  double to_m = 0.0;      ///< From the car's front to the conflict.
  double length_m = 0.0;  ///< Until its tail has left it.
  double speed_mps = 0.0;
};

bool meets(const Mine& mine, const WayConflict& conflict, const OnWay& other, double to_him_m, bool yields,
           bool waits_already, const CourseParameters& course, double judgement) {
  const double stretch_m = conflict.with_to_m - conflict.with_from_m;
  const double front_m = to_him_m - other.half_m, tail_m = front_m + 2.0 * other.half_m;
  if (tail_m + stretch_m < 0.0) return false;  // He is through.
  if (front_m <= 0.0) {
    // Within: who runs together with the driver's way and moves on is followed.
    return conflict.kind == WayConflict::Kind::crossing || other.speed_mps < crawling_mps;
  }
  if (!yields || other.speed_mps < stands_mps) return false;
  const double in_s = front_m / other.speed_mps * std::max(0.3, 1.0 + judgement);
  const double out_s = (tail_m + stretch_m) / other.speed_mps;
  if (in_s > horizon_s) return false;
  const double from_s = seconds_for(mine.to_m, mine.speed_mps),
               until_s = seconds_for(mine.to_m + mine.length_m, mine.speed_mps);
  const double doubt_s = waits_already ? 0.4 : 0.0;
  if (conflict.kind == WayConflict::Kind::merging)
    return in_s < from_s + course.gap_s + doubt_s && out_s > from_s - between_s;
  return in_s < until_s + between_s + doubt_s && out_s > from_s - between_s;
}

/// Distance from a point to a body's box in plan.
double distance_to_box(const VehicleModel& shape, const Vec2& middle_m, double heading_rad, const Vec2& point_m) {
  const Vec2 along(std::cos(heading_rad), std::sin(heading_rad)), across(-along.y, along.x);
  const Vec2 apart = point_m - middle_m;
  const double past_m = std::max(0.0, std::abs(glm::dot(apart, along)) - 0.5 * shape.length_m);
  const double beside_m = std::max(0.0, std::abs(glm::dot(apart, across)) - 0.5 * shape.width_m);
  return std::hypot(past_m, beside_m);
}

}  // namespace

std::optional<double> crossed_at_m(const traffic::Corridor& corridor, const road::RoadNetwork& network,
                                   std::span<const Participant> around, ParticipantId self, const OwnPlace& own,
                                   int lane) {
  constexpr double ahead_m = 14.0, step_m = 1.0, air_m = 0.4, across_rad = 0.35, slowest_mps = 3.0;
  const auto body = std::ranges::find(around, self, &Participant::id);
  if (body == around.end()) return std::nullopt;
  const double v = std::max(own.speed_mps, slowest_mps);
  for (double at_m = 0.5; at_m <= ahead_m; at_m += step_m) {
    const double x_m = own.x_m + own.front_m + at_m;
    if (x_m >= corridor.length_m || !traffic::lane_open(network, corridor, x_m, lane)) return std::nullopt;
    const road::LanePoint path = road::evaluate_lane(network, traffic::position_at(corridor, x_m, lane));
    const double in_s = at_m / v;
    for (const Participant& other : around) {
      if (other.id == self) continue;
      if (glm::distance(other.world_from_vehicle.position_m, path.road.position_m) > 25.0) continue;
      const VehicleModel shape = shape_of(other);
      const Vec3 heads = other.world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0);
      const double turned_rad = other.angular_velocity_radps.z * in_s;
      const double heading_rad = std::atan2(heads.y, heads.x);
      if (std::abs(road::wrap_angle(heading_rad - path.driving_heading_rad)) < across_rad) continue;
      const double mps = glm::length(Vec2(other.velocity_mps));
      const double mean_rad = heading_rad + 0.5 * turned_rad;
      const Vec2 middle_m = Vec2(other.world_from_vehicle * Vec3(shape.centre_x_m(), 0.0, 0.0)) +
                            mps * in_s * Vec2(std::cos(mean_rad), std::sin(mean_rad));
      if (distance_to_box(shape, middle_m, heading_rad + turned_rad, Vec2(path.road.position_m)) <
          own.half_width_m + air_m)
        return x_m - 1.0;
    }
  }
  return std::nullopt;
}

void look_at_junction(JunctionState& state, RouteAhead& ahead, const traffic::Corridor& corridor,
                      const CourseParameters& course, const road::RoadNetwork& network,
                      std::span<const Participant> around, ParticipantId self, const OwnPlace& own,
                      std::span<const SeenVehicle> vehicles, double judgement, double dt_s) {
  const bool waited = state.waits();
  state.waits_at_m.reset();
  state.speed_mps = std::numeric_limits<double>::infinity();
  const LaneGraph& graph = *ahead.graph;
  const auto& steps = ahead.route.steps;
  const auto body = std::ranges::find(around, self, &Participant::id);
  if (body == around.end()) return;
  const auto pieces = corridor.pieces.size();
  const auto way_of = [&](std::size_t piece) -> const Way& { return graph.ways[steps[ahead.first + piece].enters]; };
  std::vector<OnWay> others;
  bool has_looked = false;
  const auto at = static_cast<std::size_t>(&traffic::piece_at(corridor, own.x_m) - corridor.pieces.data());
  for (std::size_t k = std::max<std::size_t>(at, 1); k < pieces; ++k) {
    const Way& entry = way_of(k);
    const Way& before = graph.ways[steps[ahead.first + k - 1].leaves];
    if (!entry.in_junction() || (before.in_junction() && before.road == entry.road)) continue;
    // On the ring itself nobody is waited for but those within.
    const double line_x_m = corridor.pieces[k].x_m - (before.in_junction() ? 0.0 : before.line_before_m);
    const double left_m = line_x_m - own.x_m - own.front_m;
    if (left_m > junction_sight_m) return;
    if (left_m < -past_line_m) continue;
    if (!has_looked) {
      others = others_on_ways(graph, network, around, self, body->world_from_vehicle.position_m);
      has_looked = true;
    }
    const double v = std::max(0.0, own.speed_mps);
    const std::size_t junction = ahead.first + k;
    bool may_yield = false, must_wait = false;
    double within_m = 0.0;  // From the junction's begin.
    std::size_t last = k;
    for (; last < pieces && way_of(last).in_junction() && way_of(last).road == entry.road; ++last) {
      const Way& mine = way_of(last);
      for (const WayConflict& conflict : graph.conflicts_of(mine)) {
        if (conflict.kind == WayConflict::Kind::diverging) continue;
        const Way& his = graph.ways[conflict.with];
        bool yields = traffic::yields_to(mine, his);
        constexpr double oncoming_rad = 2.5;
        const double apart_rad = std::abs(road::wrap_angle(his.enters_rad - mine.enters_rad));
        if (before.has_light && apart_rad < oncoming_rad) yields = false;
        may_yield = may_yield || (yields && !before.has_light);
        const Mine way{left_m + (before.in_junction() ? 0.0 : before.line_before_m) + within_m + conflict.from_m,
                       conflict.to_m - conflict.from_m + own.front_m + own.rear_m, v};
        for (const OnWay& other : others) {
          if (must_wait) break;
          if (other.way != conflict.with && signals_otherwise(other.lamps, his.turns_rad)) continue;
          const auto to_him_m = distance_to(graph, other, conflict.with, conflict.with_from_m);
          if (!to_him_m) continue;
          if (state.waited_s > patience_s && other.speed_mps<stands_mps&& * to_him_m - other.half_m> 0.0) continue;
          must_wait = meets(way, conflict, other, *to_him_m, yields, waited, course, judgement);
        }
      }
      within_m += mine.length_m;
    }
    // No blocking of a junction's inside.
    const double exit_x_m = last < pieces ? corridor.pieces[last].x_m : corridor.length_m;
    const bool is_full = std::ranges::any_of(vehicles, [&](const SeenVehicle& vehicle) {
      return vehicle.is_ahead && vehicle.speed_mps < crawling_mps && vehicle.x_m > corridor.pieces[k].x_m - 2.0 &&
             vehicle.x_m < exit_x_m + room_at_exit_m + 4.0;
    });
    const bool has_conflicts = entry.conflicts.count > 0;
    must_wait = must_wait || (is_full && has_conflicts && !before.in_junction());
    if (before.has_stop && !before.has_light && state.stood_before != junction) {
      if (left_m < 2.5 && v < 0.3) state.stood_before = junction;
      must_wait = true;
    }
    if (may_yield && !before.in_junction()) {
      const double slow = before.has_stop || entry.rank == traffic::Rank::yields ? yielding_mps : unmarked_mps;
      state.speed_mps =
          std::min(state.speed_mps, std::sqrt(slow * slow + 2.0 * slows_mps2 * std::max(0.0, left_m - 2.0)));
    }
    if (must_wait && v * v / (2.0 * std::max(left_m, 0.3)) < hardest_to_wait_mps2) {
      state.waits_at_m = line_x_m - stops_before_line_m;
      state.waited_s = v < stands_mps ? state.waited_s + dt_s : 0.0;
      return;
    }
    k = last - 1;
  }
  state.waited_s = 0.0;
}

}  // namespace septet::driver
