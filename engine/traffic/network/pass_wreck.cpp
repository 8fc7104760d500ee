#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include <glm/geometric.hpp>

#include "engine/traffic/network/town_stages.hpp"

namespace septet::traffic {
namespace {

constexpr double before_m = 1.5, behind_m = 1.0;  ///< Beside a body all of a vehicle is aside from here to there.
constexpr double looks_ahead_m = 80.0, farthest_lane_m = 5.0;
constexpr double at_rest_mps = 0.1, stays_s = 5.0;
constexpr double sees_back_m = 250.0, spare_s = 3.0;

/// What lies on a way, one body behind the other with no room to turn out between them.
struct LyingStretch {
  double rear_m = 0.0, front_m = 0.0;  ///< From the way's begin.
};

bool is_body(const Presence& presence, std::span<const ForeignVehicle> foreign) {
  return presence.who < 0 && foreign[static_cast<std::size_t>(-1 - presence.who)].adrift;
}

/// True for one that has come to rest too near behind what lies there.
bool is_stuck(const TownState& town, const Presence& presence, const LyingStretch& lying) {
  if (presence.who < 0 || presence.speed_mps > at_rest_mps) return false;
  const TownVehicle& vehicle = town.vehicles[static_cast<std::size_t>(presence.who)];
  return vehicle.stands_s > stays_s && !vehicle.swerve && lying.rear_m - presence.front_m < turn_out_m;
}

std::optional<LyingStretch> lying_ahead(std::span<const Presence> on_way, std::span<const ForeignVehicle> foreign,
                                        const TownState& town, std::int32_t self, double front_m) {
  std::optional<LyingStretch> lying;
  for (const Presence& presence : on_way)
    if (is_body(presence, foreign) && presence.front_m > front_m && presence.rear_m < front_m + looks_ahead_m &&
        (!lying || presence.rear_m < lying->rear_m))
      lying = {presence.rear_m, presence.front_m};
  for (bool grows = lying.has_value(); grows;) {
    grows = false;
    for (const Presence& presence : on_way) {
      const bool is_near = presence.rear_m < lying->front_m + 2.0 * turn_out_m && presence.front_m > lying->rear_m;
      const bool belongs = is_body(presence, foreign) ? is_near : is_stuck(town, presence, *lying);
      if (presence.who == self || !belongs || presence.front_m <= front_m) continue;
      const LyingStretch with{std::min(lying->rear_m, presence.rear_m), std::max(lying->front_m, presence.front_m)};
      grows = grows || with.rear_m < lying->rear_m || with.front_m > lying->front_m;
      lying = with;
    }
  }
  return lying;
}

/// A lane beside a way, and how far to the left its middle is there.
struct Beside {
  WayIndex way = no_way;
  double left_m = 0.0;
  bool same_direction = false;
};

/// A place of a way on one beside it, of the same lane section.
double beside_m(const Way& way, const Way& other, double at_m) {
  const double share = at_m / way.length_m;
  return other.length_m * (way.along_s == other.along_s ? share : 1.0 - share);
}

/// The lanes beside a way, those of the same direction first.
std::vector<Beside> lanes_beside(const road::RoadNetwork& network, const LaneGraph& graph, const Way& way,
                                 double at_m) {
  std::vector<Beside> found;
  const PlaceOnWay here = place_on_way(graph, way, at_m);
  const double s_m = network.roads[way.road].sections[way.section].s_m + 1e-6;
  for (const int step : {-1, 1}) {
    const int lane = way.lane + step == 0 ? 2 * step + way.lane : way.lane + step;
    const WayIndex index = way_at(graph, network, way.road, lane, s_m);
    if (index == no_way) continue;
    const Way& other = graph.ways[index];
    const Vec3 apart_m = place_on_way(graph, other, beside_m(way, other, at_m)).position_m - here.position_m;
    const double left_m = here.tangent.x * apart_m.y - here.tangent.y * apart_m.x;
    if (std::abs(left_m) > farthest_lane_m || std::abs(left_m) < 1.0) continue;
    found.push_back({index, left_m, way.along_s == other.along_s});
  }
  std::ranges::stable_sort(found, {}, [](const Beside& lane) { return !lane.same_direction; });
  return found;
}

/// True where nobody is on the stretch, or comes to it within this time.
bool is_free_for(const LaneGraph& graph, const Presences& presences, std::int32_t self, WayIndex index, double from_m,
                 double to_m, double seconds, double seen_m) {
  const Way& way = graph.ways[index];
  for (const Presence& other : presences.on(index)) {
    if (other.who == self || other.rear_m > to_m) continue;
    if (other.is_there() && other.front_m > from_m) return false;
    if (other.is_there() && from_m - other.front_m < other.speed_mps * seconds) return false;
  }
  if (seen_m < from_m) return true;
  for (const WayIndex before : graph.before_of(way)) {
    const double length_m = graph.ways[before].length_m;
    if (!is_free_for(graph, presences, self, before, length_m + from_m, length_m + to_m, seconds, seen_m - from_m))
      return false;
    if (seen_m < length_m) break;
  }
  return true;
}

/// True where nobody else turns out over the same stretch of a lane.
bool is_promised(const TownState& town, std::size_t index, WayIndex way) {
  for (std::size_t k = 0; k < town.vehicles.size(); ++k)
    if (k != index && town.vehicles[k].swerve &&
        (town.vehicles[k].swerve->over == way || town.vehicles[k].swerve->own == way))
      return true;
  return false;
}

}  // namespace

double aside_of(const Swerve& swerve, double at_m, double& slope, double& curvature_per_m) {
  const bool leaves = at_m < swerve.from_m;
  const double out_m = leaves ? swerve.from_m - at_m : at_m - swerve.to_m;
  slope = curvature_per_m = 0.0;
  if (out_m <= 0.0) return swerve.left_m;
  if (out_m >= swerve_m) return 0.0;
  // A quintic that is straight at both ends.
  const double u = 1.0 - out_m / swerve_m, rest = 1.0 - u, sign = leaves ? 1.0 : -1.0;
  slope = sign * swerve.left_m * 30.0 * u * u * rest * rest / swerve_m;
  curvature_per_m = swerve.left_m * 60.0 * u * rest * (1.0 - 2.0 * u) / (swerve_m * swerve_m);
  return swerve.left_m * u * u * u * (10.0 - u * (15.0 - 6.0 * u));
}

double round_wrecks(const road::RoadNetwork& network, const LaneGraph& graph, std::span<const ForeignVehicle> foreign,
                    const Presences& presences, TownState& town, std::size_t index) {
  TownVehicle& vehicle = town.vehicles[index];
  const auto self = static_cast<std::int32_t>(index);
  if (vehicle.swerve) {
    // Over once its rear is back in its lane.
    if (vehicle.front_m - vehicle.length_m() < vehicle.swerve->to_m + swerve_m) return no_leader;
    vehicle.swerve.reset();
  }
  double begin_m = 0.0;
  for (const WayIndex own : vehicle.route) {
    const Way& way = graph.ways[own];
    const double front_m = vehicle.front_m - begin_m;
    if (-front_m > looks_ahead_m) break;
    begin_m += way.length_m;
    if (front_m > way.length_m) continue;
    const auto lying = lying_ahead(presences.on(own), foreign, town, self, front_m);
    if (!lying) continue;
    const double from_m = lying->rear_m - before_m, to_m = lying->front_m + vehicle.length_m() + behind_m;
    const double stop_m = from_m - swerve_m - front_m;
    const double end_m = to_m + swerve_m;
    if (way.in_junction() || from_m - swerve_m < 0.0 || end_m > way.length_m - way.line_before_m || stop_m < 0.0)
      return no_leader;
    const double takes_s = (end_m - front_m) / swerve_mps + spare_s;
    const bool has_room_behind = std::ranges::none_of(presences.on(own), [&](const Presence& other) {
      return other.who != self && other.is_there() && other.rear_m > lying->rear_m && other.front_m > lying->front_m &&
             other.rear_m < end_m + standing_gap_m && other.speed_mps < swerve_mps;
    });
    if (stop_m > 15.0 || !has_room_behind) return stop_m;
    for (const Beside& lane : lanes_beside(network, graph, way, 0.5 * (lying->rear_m + lying->front_m))) {
      const Way& other = graph.ways[lane.way];
      const double a = beside_m(way, other, front_m), b = beside_m(way, other, end_m);
      if (is_promised(town, index, lane.way) || is_promised(town, index, own)) continue;
      if (!is_free_for(graph, presences, self, lane.way, std::min(a, b), std::max(a, b), takes_s, sees_back_m))
        continue;
      const double to_route_m = begin_m - way.length_m;
      vehicle.swerve = Swerve{own, lane.way, to_route_m + from_m, to_route_m + to_m, lane.left_m};
      return no_leader;
    }
    return stop_m;
  }
  return no_leader;
}

void add_swerve(const LaneGraph& graph, const TownVehicle& vehicle, std::int32_t who, std::vector<Presence>& all) {
  const Swerve& swerve = *vehicle.swerve;
  double begin_m = 0.0;
  for (const WayIndex index : vehicle.route) {
    const Way& way = graph.ways[index];
    if (index == swerve.own) {
      const Way& over = graph.ways[swerve.over];
      const double rear_m = std::max(vehicle.front_m - vehicle.length_m(), swerve.from_m - swerve_m) - begin_m;
      const double a = beside_m(way, over, rear_m), b = beside_m(way, over, swerve.to_m + swerve_m - begin_m);
      Presence presence{swerve.over, who, std::max(a, b), std::min(a, b), 0.0};
      presence.claims = true;
      all.push_back(presence);
      return;
    }
    begin_m += way.length_m;
  }
}

}  // namespace septet::traffic
