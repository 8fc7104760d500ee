#include "engine/traffic/network/lane_route.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include <fmt/core.h>

#include "engine/core/printable.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"

namespace septet::traffic {
namespace {

constexpr double crowded_change_s = 20.0;
constexpr double farthest_goal_m = 200.0;

/// Time by the metre: limit, and the tightest bend of a connection.
double pace_spm(const Way& way) {
  const double bend_mps = std::sqrt(town_bend_mps2 / std::max(way.tightest_per_m, 1e-6));
  return 1.0 / std::max(1.0, way.in_junction() ? std::min(way.limit_mps, bend_mps) : way.limit_mps);
}

/// Ways beside this one are listed one after the other.
template <class Use>
void each_beside(const LaneGraph& graph, WayIndex index, const Use& use) {
  const Way& way = graph.ways[index];
  for (WayIndex other = index; other-- > 0 && is_beside(graph.ways[other], way);) use(other);
  for (WayIndex other = index + 1; other < graph.ways.size() && is_beside(graph.ways[other], way); ++other) use(other);
}

/// A way entered from its begin, or, beyond the count of ways, the one on which the route begins or one beside it.
using Node = std::uint32_t;
constexpr Node no_node = 0xFFFF'FFFFu;

struct Search {
  const LaneGraph* graph = nullptr;
  double from_m = 0.0;  ///< Where the first ways are entered.
  std::vector<double> best_s;
  std::vector<Node> before;
  std::priority_queue<std::pair<double, Node>, std::vector<std::pair<double, Node>>, std::greater<>> open;

  explicit Search(const LaneGraph& of)
      : graph(&of),
        best_s(2 * of.ways.size(), std::numeric_limits<double>::infinity()),
        before(2 * of.ways.size(), no_node) {}

  Node count() const { return static_cast<Node>(graph->ways.size()); }
  WayIndex way_of(Node node) const { return node < count() ? node : node - count(); }
  double entered_m(Node node) const { return node < count() ? 0.0 : from_m; }

  void reach(Node node, double at_s, Node from) {
    if (!(at_s < best_s[node])) return;
    best_s[node] = at_s;
    before[node] = from;
    open.emplace(at_s, node);
  }

  void go_on(Node node) {
    const Way& way = graph->ways[way_of(node)];
    const double left_m = std::max(0.0, way.length_m - entered_m(node));
    for (const WayIndex next : graph->next_of(way))
      if (next != way_of(node)) reach(next, best_s[node] + left_m * pace_spm(way), node);
    if (way.in_junction()) return;
    const double change_s = lane_change_s + (left_m < room_for_change_m ? crowded_change_s : 0.0);
    each_beside(*graph, way_of(node), [&](WayIndex beside) {
      const int lanes = std::abs(graph->ways[beside].lane - way.lane);
      reach(node < count() ? beside : beside + count(), best_s[node] + change_s * lanes, node);
    });
  }
};

/// Steps from the nodes passed, the first one last.
LaneRoute route_of(const Search& search, const std::vector<Node>& nodes, const PlaceOnLane& from,
                   const PlaceOnLane& to) {
  const LaneGraph& graph = *search.graph;
  LaneRoute route;
  route.length_m = -from.at_m;
  route.from = from;
  route.to = to;
  Node last = no_node;
  for (const Node node : nodes) {
    const WayIndex way = search.way_of(node);
    const bool changes = last != no_node && (last < search.count()) == (node < search.count()) &&
                         is_beside(graph.ways[route.steps.back().leaves], graph.ways[way]);
    if (!changes) {
      if (last != no_node) route.length_m += graph.ways[route.steps.back().leaves].length_m;
      route.steps.push_back({way, way, route.length_m});
    }
    route.steps.back().leaves = way;
    last = node;
  }
  route.length_m += to.at_m;
  return route;
}

bool read_number(std::string_view text, double& value) {
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  return fault == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
}

}  // namespace

bool is_beside(const Way& a, const Way& b) {
  return a.road == b.road && a.section == b.section && a.along_s == b.along_s;
}

std::optional<LaneRoute> plan_route(const LaneGraph& graph, const PlaceOnLane& from, std::span<const PlaceOnLane> to) {
  if (from.way >= graph.ways.size() || to.empty()) return std::nullopt;
  Search search(graph);
  search.from_m = from.at_m;
  search.reach(from.way + search.count(), 0.0, no_node);
  double least_s = std::numeric_limits<double>::infinity();
  Node end = no_node;
  const PlaceOnLane* goal = nullptr;
  while (!search.open.empty()) {
    const auto [at_s, node] = search.open.top();
    search.open.pop();
    if (at_s >= least_s) break;
    if (at_s > search.best_s[node]) continue;
    for (const PlaceOnLane& place : to) {
      if (place.way != search.way_of(node) || place.at_m < search.entered_m(node)) continue;
      const double there_s = at_s + (place.at_m - search.entered_m(node)) * pace_spm(graph.ways[place.way]);
      if (there_s < least_s) least_s = there_s, end = node, goal = &place;
    }
    search.go_on(node);
  }
  if (!goal) return std::nullopt;
  std::vector<Node> nodes;
  for (Node node = end; node != no_node; node = search.before[node]) nodes.push_back(node);
  std::ranges::reverse(nodes);
  LaneRoute route = route_of(search, nodes, from, *goal);
  route.time_s = least_s;
  route.reached_m = {route.length_m};
  return route;
}

std::optional<LaneRoute> plan_route_over(const LaneGraph& graph, const PlaceOnLane& from,
                                         std::span<const std::vector<PlaceOnLane>> places) {
  std::optional<LaneRoute> whole;
  for (const std::vector<PlaceOnLane>& place : places) {
    const auto leg = plan_route(graph, whole ? whole->to : from, place);
    if (!leg) return std::nullopt;
    if (!whole) {
      whole = leg;
      continue;
    }
    // Both hold the section of the place between them.
    whole->steps.back().leaves = leg->steps.front().leaves;
    for (std::size_t i = 1; i < leg->steps.size(); ++i) {
      whole->steps.push_back(leg->steps[i]);
      whole->steps.back().begins_m += whole->length_m;
    }
    whole->length_m += leg->length_m;
    whole->reached_m.push_back(whole->length_m);
    whole->time_s += leg->time_s;
    whole->to = leg->to;
  }
  return whole;
}

std::vector<PlaceOnLane> lanes_under(const LaneGraph& graph, const road::RoadNetwork& network, const Vec2& world_m,
                                     double heading_rad) {
  constexpr double widest_rad = 1.2;
  std::vector<std::pair<double, PlaceOnLane>> found;
  for (const road::Location& location : road::roads_holding(network, world_m)) {
    const road::RoadPosition& there = location.position;
    if (location.lanes.lane == 0) continue;
    const WayIndex index = way_at(graph, network, there.road, location.lanes.lane, there.s_m);
    if (index == no_way) continue;
    const Way& way = graph.ways[index];
    const road::LaneSection& section = network.roads[way.road].sections[way.section];
    const double share = (there.s_m - section.s_m) / std::max(section.s_end_m - section.s_m, 1e-6);
    const double at_m = std::clamp(way.along_s ? share : 1.0 - share, 0.0, 1.0) * way.length_m;
    const Vec3 tangent = place_on_way(graph, way, at_m).tangent;
    const double off_rad = std::abs(road::wrap_angle(std::atan2(tangent.y, tangent.x) - heading_rad));
    if (off_rad < widest_rad) found.emplace_back(off_rad, PlaceOnLane{index, at_m});
  }
  std::ranges::stable_sort(found, {}, &std::pair<double, PlaceOnLane>::first);
  std::vector<PlaceOnLane> lanes;
  lanes.reserve(found.size());
  for (const auto& [off_rad, place] : found) lanes.push_back(place);
  return lanes;
}

std::vector<PlaceOnLane> lanes_at(const LaneGraph& graph, const road::RoadNetwork& network, road::RoadIndex road,
                                  double s_m) {
  std::vector<PlaceOnLane> lanes;
  const road::LaneSection& section = road::section_at(network.roads[road], s_m);
  const double share = std::clamp((s_m - section.s_m) / std::max(section.s_end_m - section.s_m, 1e-6), 0.0, 1.0);
  for (const road::Lane& lane : section.lanes) {
    const WayIndex index = way_at(graph, network, road, lane.id, s_m);
    if (index == no_way) continue;
    const Way& way = graph.ways[index];
    lanes.push_back({index, (way.along_s ? share : 1.0 - share) * way.length_m});
  }
  return lanes;
}

Expected<std::vector<PlaceOnLane>> find_goal(const LaneGraph& graph, const road::RoadNetwork& network,
                                             std::string_view place) {
  const auto no_place = [&](const char* what) {
    return failure(fmt::format("{}: \"{}\"", what, printable(place.substr(0, 100))), "goal",
                   "give a road's name, its id, id:s in metres, or x,y of the world");
  };
  std::vector<PlaceOnLane> found;
  const auto add = [&](road::RoadIndex road, double s_m) {
    const auto lanes = lanes_at(graph, network, road, s_m);
    found.insert(found.end(), lanes.begin(), lanes.end());
  };
  Vec2 world_m(0.0);
  if (const auto comma = place.find(','); comma != place.npos && read_number(place.substr(0, comma), world_m.x) &&
                                          read_number(place.substr(comma + 1), world_m.y)) {
    if (std::max(std::abs(world_m.x), std::abs(world_m.y)) > 1e7) return no_place("no road is near this place");
    const auto near = road::locate(network, world_m, nullptr, farthest_goal_m);
    if (!near) return no_place("no road is near this place");
    add(near->position.road, near->position.s_m);
    if (found.empty()) return no_place("nobody drives on the road at this place");
    return found;
  }
  for (road::RoadIndex index = 0; index < network.roads.size(); ++index)
    if (const road::Road& road = network.roads[index]; road.id == place || (!place.empty() && road.name == place))
      add(index, 0.5 * road.length_m);
  if (const auto colon = place.rfind(':'); found.empty() && colon != place.npos) {
    const auto road = road::find_road(network, std::string(place.substr(0, colon)));
    double s_m = 0.0;
    if (!road || !read_number(place.substr(colon + 1), s_m)) return no_place("there is no such road and station");
    if (s_m < 0.0 || s_m > network.roads[*road].length_m) return no_place("the road does not reach so far");
    add(*road, s_m);
  }
  if (found.empty()) return no_place("there is no road to drive on of this name or id");
  return found;
}

std::vector<WayIndex> lanes_for_next(const LaneGraph& graph, const LaneRoute& route, std::size_t step) {
  std::vector<WayIndex> lanes{route.steps[step].leaves};
  if (step + 1 == route.steps.size()) return lanes;
  const Way& next = graph.ways[route.steps[step + 1].enters];
  each_beside(graph, route.steps[step].leaves, [&](WayIndex beside) {
    const auto on = graph.next_of(graph.ways[beside]);
    if (std::ranges::any_of(on, [&](WayIndex way) { return is_beside(graph.ways[way], next); }))
      lanes.push_back(beside);
  });
  std::ranges::sort(lanes);
  return lanes;
}

}  // namespace septet::traffic
