#include "engine/traffic/network/route_turns.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace septet::traffic {
namespace {

constexpr double straight_rad = 0.5, back_rad = 2.6;
/// Ways out of a junction whose turns differ by less lead to one arm.
constexpr double one_arm_rad = 0.3;
/// Another way counts as straight on up to here.
constexpr double nearly_straight_rad = 0.75;

bool is_of_junction(const road::RoadNetwork& network, const Way& way) {
  return network.roads[way.road].junction != road::no_index;
}

/// Turns of all ways on from a section.
std::vector<double> turns_from(const LaneGraph& graph, WayIndex from) {
  std::vector<double> turns;
  const Way& way = graph.ways[from];
  const auto add = [&](WayIndex lane) {
    for (const WayIndex next : graph.next_of(graph.ways[lane])) turns.push_back(graph.ways[next].turns_rad);
  };
  for (WayIndex lane = from + 1; lane-- > 0 && is_beside(graph.ways[lane], way);) add(lane);
  for (WayIndex lane = from + 1; lane < graph.ways.size() && is_beside(graph.ways[lane], way); ++lane) add(lane);
  return turns;
}

RouteTurn turn_at(const LaneGraph& graph, const RouteStep& before, const RouteStep& in) {
  const double turn_rad = graph.ways[in.enters].turns_rad;
  RouteTurn turn;
  turn.at_m = in.begins_m;
  std::vector<double> others = turns_from(graph, before.leaves);
  std::erase_if(others, [&](double other) { return std::abs(other - turn_rad) < one_arm_rad; });
  const auto is_rival = [](double other) { return std::abs(other) < nearly_straight_rad; };
  const bool rivals = std::ranges::any_of(others, is_rival);
  if (std::abs(turn_rad) < straight_rad) {
    turn.is_told = rivals;
    if (rivals) {
      const bool further_left =
          std::ranges::all_of(others, [&](double other) { return !is_rival(other) || other < turn_rad; });
      const bool further_right =
          std::ranges::all_of(others, [&](double other) { return !is_rival(other) || other > turn_rad; });
      const bool straightest = std::ranges::all_of(
          others, [&](double other) { return std::abs(turn_rad) + 0.5 * one_arm_rad < std::abs(other); });
      if (!straightest && further_left) turn.word.what = Guided::bear_left;
      if (!straightest && further_right) turn.word.what = Guided::bear_right;
    }
  } else {
    turn.word.what = std::abs(turn_rad) > back_rad ? Guided::turn_back : turn_rad > 0.0 ? Guided::left : Guided::right;
    turn.is_told = !others.empty();
  }
  return turn;
}

bool forks(const LaneGraph& graph, WayIndex from) {
  const Way& way = graph.ways[from];
  std::vector<road::RoadIndex> roads;
  const auto add = [&](WayIndex lane) {
    for (const WayIndex next : graph.next_of(graph.ways[lane])) roads.push_back(graph.ways[next].road);
  };
  for (WayIndex lane = from + 1; lane-- > 0 && is_beside(graph.ways[lane], way);) add(lane);
  for (WayIndex lane = from + 1; lane < graph.ways.size() && is_beside(graph.ways[lane], way); ++lane) add(lane);
  return std::ranges::any_of(roads, [&](road::RoadIndex road) { return road != roads.front(); });
}

}  // namespace

std::vector<RouteTurn> route_turns(const LaneGraph& graph, const road::RoadNetwork& network, const LaneRoute& route) {
  std::vector<RouteTurn> turns;
  const auto& steps = route.steps;
  const auto on_ring = [&](const RouteStep& step) {
    const Way& way = graph.ways[step.enters];
    return way.on_ring || way.onto_ring;
  };
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const Way &way = graph.ways[steps[i].enters], &before = graph.ways[steps[i - 1].leaves];
    if (way.onto_ring && !on_ring(steps[i - 1])) {
      RouteTurn turn{{Guided::roundabout, false, 0}, steps[i].begins_m, 0.0, true};
      int exits = 0;
      while (i + 1 < steps.size() && on_ring(steps[i + 1])) {
        if (forks(graph, steps[i].leaves)) ++exits;
        ++i;
      }
      const bool leaves = i + 1 < steps.size();
      turn.ends_m = leaves ? steps[i + 1].begins_m : route.length_m;
      turn.word.exit = static_cast<std::uint8_t>(leaves ? std::min(exits, 99) : 0);
      if (exits > 0) turns.push_back(turn);
      continue;
    }
    if (!is_of_junction(network, way) || way.road == before.road || is_of_junction(network, before)) continue;
    RouteTurn turn = turn_at(graph, steps[i - 1], steps[i]);
    const std::vector<double> all = turns_from(graph, steps[i - 1].leaves);
    // A connection where the road does not fork is no crossing.
    if (std::ranges::all_of(all, [&](double one) { return std::abs(one - all.front()) < one_arm_rad; })) continue;
    while (i + 1 < steps.size() && is_of_junction(network, graph.ways[steps[i + 1].enters])) ++i;
    turn.ends_m = i + 1 < steps.size() ? steps[i + 1].begins_m : route.length_m;
    turns.push_back(turn);
  }
  turns.push_back({{Guided::arrive, false, 0}, route.length_m, route.length_m, true});
  return turns;
}

std::vector<WayIndex> lanes_towards_turn(const LaneGraph& graph, const LaneRoute& route, std::size_t step) {
  std::size_t last = step;
  while (last + 1 < route.steps.size() && !graph.ways[route.steps[last + 1].enters].in_junction()) ++last;
  std::vector<WayIndex> lanes = lanes_for_next(graph, route, last);
  for (std::size_t i = last; i-- > step;) {
    std::vector<WayIndex> before;
    const Way& way = graph.ways[route.steps[i].leaves];
    const auto leads = [&](WayIndex lane) {
      return std::ranges::any_of(graph.next_of(graph.ways[lane]),
                                 [&](WayIndex next) { return std::ranges::binary_search(lanes, next); });
    };
    WayIndex first = route.steps[i].leaves;
    while (first > 0 && is_beside(graph.ways[first - 1], way)) --first;
    for (WayIndex lane = first; lane < graph.ways.size() && is_beside(graph.ways[lane], way); ++lane)
      if (leads(lane)) before.push_back(lane);
    if (before.empty()) before.push_back(route.steps[i].leaves);
    lanes = std::move(before);
  }
  return lanes;
}

}  // namespace septet::traffic
