#include "engine/driver/route_ahead.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <glm/geometric.hpp>

#include "engine/world/find_effect.hpp"
#include "engine/world/guidance.hpp"

namespace septet::driver {
namespace {

constexpr std::size_t steps_behind = 3;
constexpr double more_within_m = 250.0, middle_m = 1.4;
constexpr int first_number = 20;  ///< So that lanes further inside have numbers too.
constexpr double within_section_m = 1e-3;

/// A way's section as a piece, from x on.
traffic::CorridorPiece piece_of_step(const traffic::LaneGraph& graph, const road::RoadNetwork& network,
                                     const traffic::RouteStep& step, double x_m) {
  const traffic::Way& way = graph.ways[step.leaves];
  const road::LaneSection& section = network.roads[way.road].sections[way.section];
  traffic::CorridorPiece piece;
  piece.road = way.road;
  piece.along_s = way.along_s;
  piece.side = way.lane > 0 ? 1 : -1;
  piece.x_m = x_m;
  piece.length_m = section.s_end_m - section.s_m;
  piece.from_s_m = section.s_m;
  piece.inset_m = std::min(within_section_m, 0.01 * piece.length_m);
  piece.lane = way.lane;
  return piece;
}

/// Steps on which the car may be: the first one from `from` on.
std::optional<std::size_t> step_under(const RouteAhead& ahead, const road::RoadNetwork& network, const Participant& car,
                                      std::size_t from) {
  const Vec3 heads = car.world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0);
  const double heading_rad = std::atan2(heads.y, heads.x);
  for (const double forward_m : {middle_m, 0.0}) {
    const auto under = traffic::lanes_under(*ahead.graph, network,
                                            Vec2(car.world_from_vehicle.position_m + forward_m * heads), heading_rad);
    for (std::size_t i = from; i < ahead.route.steps.size(); ++i)
      for (const traffic::PlaceOnLane& place : under)
        if (is_beside(ahead.graph->ways[place.way], ahead.graph->ways[ahead.route.steps[i].enters])) return i;
  }
  return std::nullopt;
}

}  // namespace

bool learn_route(RouteAhead& ahead, const road::RoadNetwork& network, const Snapshot& snapshot) {
  const EffectKeyframe* told = find_effect(snapshot, guided_route_effect_id, guided_route_keyframe_kind);
  if (!told) {
    if (!ahead.leads()) return false;
    ahead.route = {};
    ahead.found_at.reset();
    return true;
  }
  if (ahead.found_at == told->tick) return false;
  ahead.found_at = told->tick;
  const bool led = ahead.leads();
  ahead.route = {};
  ahead.step = 0;
  const auto route = decode_guided_route(told->data);
  if (!route) return led;
  if (!ahead.graph) ahead.graph = std::make_shared<const traffic::LaneGraph>(traffic::build_lane_graph(network));
  const traffic::LaneGraph& graph = *ahead.graph;
  for (const GuidedSection& section : route->sections) {
    if (section.road >= network.roads.size() || section.section >= network.roads[section.road].sections.size()) break;
    const road::LaneSection& lanes = network.roads[section.road].sections[section.section];
    const double middle_s_m = 0.5 * (lanes.s_m + lanes.s_end_m);
    const auto way = [&](int lane) {
      return lanes.has_lane(lane) ? traffic::way_at(graph, network, section.road, lane, middle_s_m) : traffic::no_way;
    };
    const traffic::RouteStep step{way(section.enters), way(section.leaves), 0.0};
    if (step.enters == traffic::no_way || step.leaves == traffic::no_way) break;
    ahead.route.steps.push_back(step);
  }
  ahead.route.to.at_m = route->ends_m;
  return true;
}

std::optional<traffic::Corridor> route_corridor(RouteAhead& ahead, const road::RoadNetwork& network,
                                                const Snapshot& snapshot, const traffic::Corridor* before) {
  if (!ahead.leads()) return std::nullopt;
  const Participant* car = find_participant(snapshot, snapshot.driver_car.participant);
  if (!car) return std::nullopt;
  const auto here = step_under(ahead, network, *car, ahead.step);
  if (!here) return std::nullopt;
  ahead.step = *here;
  const auto& steps = ahead.route.steps;
  const traffic::LaneGraph& graph = *ahead.graph;
  const auto road_of = [&](std::size_t i) { return graph.ways[steps[i].enters].road; };
  // Back a little, and on, as long as no road comes again.
  std::size_t first = *here;
  std::vector<road::RoadIndex> roads{road_of(first)};
  const auto is_new = [&](std::size_t i, std::size_t neighbour) {
    return road_of(i) == road_of(neighbour) || std::ranges::find(roads, road_of(i)) == roads.end();
  };
  while (first > 0 && *here - first < steps_behind && is_new(first - 1, first)) roads.push_back(road_of(--first));
  std::size_t end = *here + 1;
  while (end < steps.size() && is_new(end, end - 1)) roads.push_back(road_of(end++));
  traffic::Corridor corridor;
  corridor.is_route = true;
  double x_m = 0.0;
  int number = first_number;  // Of the lane in which the step is entered.
  for (std::size_t i = first; i < end; ++i) {
    traffic::CorridorPiece piece = piece_of_step(graph, network, steps[i], x_m);
    piece.lane_shift = number - std::abs(graph.ways[steps[i].enters].lane);
    number = std::abs(piece.lane) + piece.lane_shift;
    x_m += piece.length_m;
    corridor.pieces.push_back(piece);
  }
  // As it was for the car.
  double moved_m = 0.0;
  int renumbered = 0;
  const traffic::CorridorPiece& own = corridor.pieces[*here - first];
  if (before && before->is_route) {
    const auto same = std::ranges::find_if(before->pieces, [&](const traffic::CorridorPiece& piece) {
      return piece.road == own.road && piece.from_s_m == own.from_s_m && piece.along_s == own.along_s;
    });
    if (same != before->pieces.end()) {
      moved_m = same->x_m - own.x_m;
      renumbered = same->lane_shift - own.lane_shift;
    }
  }
  for (traffic::CorridorPiece& piece : corridor.pieces) {
    piece.x_m += moved_m;
    piece.lane_shift += renumbered;
  }
  corridor.length_m = x_m + moved_m;
  ahead.first = first;
  ahead.goal_x_m = std::numeric_limits<double>::infinity();
  if (end == steps.size()) {
    const traffic::CorridorPiece& last = corridor.pieces.back();
    const double share = ahead.route.to.at_m / graph.ways[steps.back().leaves].length_m;
    ahead.goal_x_m = last.x_m + std::clamp(share, 0.0, 1.0) * last.length_m;
  }
  return corridor;
}

bool needs_more(const RouteAhead& ahead, const traffic::Corridor& corridor, double x_m) {
  return corridor.length_m - x_m < more_within_m && std::isinf(ahead.goal_x_m) &&
         x_m > corridor.pieces.front().x_m + corridor.pieces.front().length_m;
}

WantedLane wanted_lane(RouteAhead& ahead, const traffic::Corridor& corridor, double x_m) {
  const auto at = static_cast<std::size_t>(&traffic::piece_at(corridor, x_m) - corridor.pieces.data());
  ahead.step = std::max(ahead.step, ahead.first + at);
  const auto& steps = ahead.route.steps;
  const auto in_junction = [&](std::size_t i) {
    return ahead.graph->ways[steps[ahead.first + i].enters].in_junction();
  };
  std::size_t last = at;
  while (last + 1 < corridor.pieces.size() && !in_junction(last + 1)) ++last;
  const traffic::CorridorPiece& before = corridor.pieces[last];
  return {std::abs(before.lane) + before.lane_shift, before.x_m + before.length_m - x_m};
}

bool is_at_junction(const RouteAhead& ahead, const traffic::Corridor& corridor, double x_m) {
  constexpr double near_m = 8.0;
  return std::ranges::any_of(std::array{x_m, x_m + near_m}, [&](double at_m) {
    const auto piece = static_cast<std::size_t>(&traffic::piece_at(corridor, at_m) - corridor.pieces.data());
    return ahead.graph->ways[ahead.route.steps[ahead.first + piece].enters].in_junction();
  });
}

}  // namespace septet::driver
