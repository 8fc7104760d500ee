#include "engine/scenario/run/route.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <queue>
#include <set>
#include <tuple>

#include "engine/road/lane_geometry.hpp"

namespace septet::scenario {
namespace {

constexpr int most_lanes_beside = 20;
constexpr double longer_than_any_m = 1e9;

/// A lane of a section and its direction of travel.
struct Node {
  road::RoadIndex road = 0;
  std::uint32_t section = 0;
  int lane = 0;
  bool along_s = true;

  auto key() const { return std::tie(road, section, lane, along_s); }
  bool operator<(const Node& other) const { return key() < other.key(); }
};

double length_m(const road::RoadNetwork& network, const Node& node) {
  const road::Road& on = network.roads[node.road];
  const double end = node.section + 1 < on.sections.size() ? on.sections[node.section + 1].s_m : on.length_m;
  return end - on.sections[node.section].s_m;
}

bool is_at(const Node& node, const Waypoint& waypoint) {
  return node.road == waypoint.lane.road && node.along_s == waypoint.along_s;
}

/// The lanes of the shortest path behind `from` that ends on the waypoint's road, from a lane beside it of the same
/// direction only where none leads there from `from`; empty: there is none.
std::vector<Node> find_way(const road::RoadNetwork& network, const Node& from, const Waypoint& to,
                           std::size_t& lanes_left) {
  struct Reached {
    double way_m;
    Node node, before;
    bool operator<(const Reached& other) const { return std::tie(other.way_m, other.node) < std::tie(way_m, node); }
  };
  std::priority_queue<Reached> open;
  const auto go_on = [&](const Node& node, double way_m) {
    for (const auto& next : road::continuations(network, node.road, node.section, node.lane, node.along_s)) {
      open.push({way_m, {next.road, next.section, next.lane, next.towards_increasing_s}, node});
    }
  };
  const auto& section = network.roads[from.road].sections[from.section];
  std::set<Node> first;
  for (int beside = -most_lanes_beside; beside <= most_lanes_beside; ++beside) {
    Node lane = from;
    lane.lane += beside;
    const bool same_way = lane.lane != 0 && (lane.lane > 0) == (from.lane > 0);
    if (!same_way || !section.has_lane(lane.lane)) continue;
    first.insert(lane);
    go_on(lane, longer_than_any_m * std::abs(beside));
  }
  std::map<Node, Node> came_from;
  for (; !open.empty() && lanes_left > 0; --lanes_left) {
    const Reached best = open.top();
    open.pop();
    if (!came_from.try_emplace(best.node, best.before).second) continue;
    if (!is_at(best.node, to)) {
      go_on(best.node, best.way_m + length_m(network, best.node));
      continue;
    }
    std::vector<Node> way{best.node};
    while (!first.contains(came_from.at(way.back()))) way.push_back(came_from.at(way.back()));
    std::reverse(way.begin(), way.end());
    return way;
  }
  return {};
}

}  // namespace

std::vector<road::RoadIndex> plan_route(const road::RoadNetwork& network, std::span<const Waypoint> waypoints,
                                        std::size_t& lanes_left) {
  std::vector<road::RoadIndex> roads;
  if (waypoints.empty()) return roads;
  const Waypoint& first = waypoints.front();
  const road::Road& on = network.roads[first.lane.road];
  Node at{first.lane.road, static_cast<std::uint32_t>(road::section_index_at(on, first.lane.s_m)), first.lane.lane,
          first.along_s};
  roads.push_back(at.road);
  double s_m = first.lane.s_m;
  for (const Waypoint& waypoint : waypoints.subspan(1)) {
    const double ahead_m = waypoint.along_s ? waypoint.lane.s_m - s_m : s_m - waypoint.lane.s_m;
    s_m = waypoint.lane.s_m;
    if (is_at(at, waypoint) && ahead_m >= 0.0) continue;
    const auto way = find_way(network, at, waypoint, lanes_left);
    if (way.empty()) break;
    for (const Node& node : way) {
      if (roads.back() != node.road) roads.push_back(node.road);
    }
    at = way.back();
  }
  return roads;
}

road::ChooseContinuation choose_way(const road::RoadNetwork& network, std::span<const road::RoadIndex> roads) {
  return [&network, roads](std::span<const road::LaneContinuation> ways) {
    std::size_t best = 0;
    auto soonest = roads.end();
    double least = 1e300;
    for (std::size_t i = 0; i < ways.size(); ++i) {
      const road::RoadIndex index = ways[i].road;
      const auto on_route = std::find(roads.begin(), soonest, index);
      if (on_route != soonest) {
        soonest = on_route;
        best = i;
      }
      if (soonest != roads.end()) continue;
      const double from = road::evaluate(network, {index, 0.0, 0.0}).heading_rad;
      const double to = road::evaluate(network, {index, network.roads[index].length_m, 0.0}).heading_rad;
      const double turn = std::abs(road::wrap_angle(to - from));
      if (turn < least - 1e-6) {
        least = turn;
        best = i;
      }
    }
    return best;
  };
}

}  // namespace septet::scenario
