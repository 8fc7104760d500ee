#include "engine/traffic/network/lane_graph.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/lane_links.hpp"
#include "engine/road/road_position.hpp"
#include "engine/traffic/lane_way.hpp"
#include "engine/traffic/network/lane_graph_parts.hpp"

namespace septet::traffic {
namespace {

constexpr double way_step_m = 2.0, junction_step_m = 1.0;
constexpr double least_length_m = 1e-3;
constexpr double no_bend_m2ps2 = 1e4;

/// Station at a share of the section, in the direction of travel. Just within it, where its lanes hold.
double station_of_share(const road::LaneSection& section, bool along_s, double share) {
  const double inside_m = std::min(1e-6, 1e-3 * (section.s_end_m - section.s_m));
  const double from = section.s_m + inside_m, to = section.s_end_m - inside_m;
  return along_s ? from + share * (to - from) : to - share * (to - from);
}

WayPoint point_at(const road::RoadNetwork& network, const Way& way, double s_m) {
  const road::LanePoint lane = road::evaluate_lane(network, {way.road, way.lane, s_m, 0.0});
  WayPoint point;
  point.position_m = lane.road.position_m;
  point.width_m = lane.lane_width_m;
  // The road's pitch against the lane's direction of travel.
  const double pitch = way.along_s ? lane.road.pitch_rad : -lane.road.pitch_rad;
  point.tangent = {std::cos(pitch) * std::cos(lane.driving_heading_rad),
                   std::cos(pitch) * std::sin(lane.driving_heading_rad), -std::sin(pitch)};
  return point;
}

double turn_between(const Vec3& from, const Vec3& to) {
  return std::atan2(from.x * to.y - from.y * to.x, from.x * to.x + from.y * to.y);
}

/// Points evenly spaced by length: the length is measured at even stations first.
void append_points(const road::RoadNetwork& network, Way& way, LaneGraph& graph) {
  const road::LaneSection& section = network.roads[way.road].sections[way.section];
  const double step = way.in_junction() ? junction_step_m : way_step_m;
  const auto count =
      std::max<std::size_t>(2, static_cast<std::size_t>(std::ceil((section.s_end_m - section.s_m) / step)) + 1);
  std::vector<double> length_m(count, 0.0);
  const auto share_of = [&](std::size_t k) { return static_cast<double>(k) / static_cast<double>(count - 1); };
  Vec3 last = point_at(network, way, station_of_share(section, way.along_s, 0.0)).position_m;
  for (std::size_t k = 1; k < count; ++k) {
    const Vec3 here = point_at(network, way, station_of_share(section, way.along_s, share_of(k))).position_m;
    length_m[k] = length_m[k - 1] + glm::distance(last, here);
    last = here;
  }
  way.length_m = std::max(least_length_m, length_m.back());
  way.points = {static_cast<std::uint32_t>(graph.points.size()), static_cast<std::uint32_t>(count)};
  std::size_t k = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double at = share_of(i) * length_m.back();
    while (k + 2 < count && length_m[k + 1] < at) ++k;
    const double piece = length_m[k + 1] - length_m[k];
    const double part = piece > 0.0 ? std::clamp((at - length_m[k]) / piece, 0.0, 1.0) : 0.0;
    const double share = (static_cast<double>(k) + part) / static_cast<double>(count - 1);
    graph.points.push_back(point_at(network, way, station_of_share(section, way.along_s, share)));
  }
}

/// Curvature from the turn between neighbouring points, and the speed that it allows, braking before it.
void find_bends(Way& way, LaneGraph& graph) {
  WayPoint* points = graph.points.data() + way.points.first;
  const std::size_t count = way.points.count;
  const double step = way.length_m / static_cast<double>(count - 1);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t low = i == 0 ? 0 : i - 1, high = std::min(i + 1, count - 1);
    const double apart_m = std::max(step * static_cast<double>(high - low), 0.1);
    points[i].curvature_per_m = turn_between(points[low].tangent, points[high].tangent) / apart_m;
  }
  for (std::size_t i = count; i-- > 0;) {
    const double curvature = std::abs(points[i].curvature_per_m);
    way.tightest_per_m = std::max(way.tightest_per_m, curvature);
    points[i].bend_m2ps2 = std::min(no_bend_m2ps2, town_bend_mps2 / std::max(curvature, 1e-9));
    if (i + 1 < count)
      points[i].bend_m2ps2 = std::min(points[i].bend_m2ps2, points[i + 1].bend_m2ps2 + 2.0 * ease_off_mps2 * step);
  }
}

/// Every driving lane of every section.
void list_ways(const road::RoadNetwork& network, LaneGraph& graph) {
  for (road::RoadIndex index = 0; index < network.roads.size(); ++index) {
    const road::Road& road = network.roads[index];
    graph.first_section.push_back(static_cast<std::uint32_t>(graph.first_lane.size()));
    for (std::uint32_t s = 0; s < road.sections.size(); ++s) {
      const road::LaneSection& section = road.sections[s];
      graph.first_lane.push_back(static_cast<std::uint32_t>(graph.way_of_lane.size()));
      for (const road::Lane& lane : section.lanes) {
        graph.way_of_lane.push_back(no_way);
        if (lane.id == 0 || !road::is_drivable(lane.type)) continue;
        graph.way_of_lane.back() = static_cast<WayIndex>(graph.ways.size());
        Way& way = graph.ways.emplace_back();
        way.road = index, way.section = s, way.lane = lane.id;
        way.along_s = road::runs_along_s(road, section, lane.id);
        way.left_hand = road.rule == road::TrafficRule::left_hand;
        way.junction = road.junction;
        const double limit =
            road::speed_limit_mps(network, {index, lane.id, 0.5 * (section.s_m + section.s_end_m), 0.0});
        way.limit_mps = limit > 0.0 ? limit : 0.0;
      }
    }
  }
}

WayIndex way_of(const LaneGraph& graph, const road::RoadNetwork& network, road::RoadIndex road, std::uint32_t section,
                int lane) {
  const road::LaneSection& lanes = network.roads[road].sections[section];
  if (!lanes.has_lane(lane)) return no_way;
  const std::uint32_t first = graph.first_lane[graph.first_section[road] + section];
  return graph.way_of_lane[first + static_cast<std::uint32_t>(lanes.left_count - lane)];
}

void link_ways(const road::RoadNetwork& network, LaneGraph& graph) {
  std::vector<std::vector<WayIndex>> before(graph.ways.size());
  for (WayIndex index = 0; index < graph.ways.size(); ++index) {
    Way& way = graph.ways[index];
    way.next.first = static_cast<std::uint32_t>(graph.next.size());
    for (const road::LaneContinuation& to :
         road::continuations(network, way.road, way.section, way.lane, way.along_s)) {
      const WayIndex next = way_of(graph, network, to.road, to.section, to.lane);
      // A link may lead against the traffic of the lane.
      if (next == no_way || graph.ways[next].along_s != to.towards_increasing_s) continue;
      graph.next.push_back(next);
      before[next].push_back(index);
    }
    way.next.count = static_cast<std::uint32_t>(graph.next.size()) - way.next.first;
  }
  for (WayIndex index = 0; index < graph.ways.size(); ++index) {
    graph.ways[index].before = {static_cast<std::uint32_t>(graph.before.size()),
                                static_cast<std::uint32_t>(before[index].size())};
    graph.before.insert(graph.before.end(), before[index].begin(), before[index].end());
  }
}

/// Ways outside of junctions that run into one: where lanes end, or a file has no junction for a fork. They are a
/// junction of their own, so that right of way is settled before them.
void mark_merges(LaneGraph& graph) {
  constexpr double longest_m = 60.0;
  auto next_junction = road::no_index - 1;
  for (const Way& way : graph.ways) {
    const auto before = graph.before_of(way);
    if (before.size() < 2) continue;
    for (const WayIndex index : before)
      if (Way& merging = graph.ways[index]; !merging.in_junction() && merging.length_m < longest_m)
        merging.junction = next_junction;
    --next_junction;
  }
}

/// A connection without a limit of its own has that of the road before it.
void fill_limits(LaneGraph& graph) {
  for (int round = 0; round < 4; ++round)
    for (Way& way : graph.ways)
      if (way.limit_mps <= 0.0)
        for (const WayIndex before : graph.before_of(way))
          way.limit_mps = std::max(way.limit_mps, graph.ways[before].limit_mps);
  for (Way& way : graph.ways)
    if (way.limit_mps <= 0.0) way.limit_mps = unposted_mps;
}

/// Ways from which every drive ends: those without a next one, and those that lead to such ones alone.
void find_dead_ends(LaneGraph& graph) {
  std::vector<std::uint32_t> open(graph.ways.size());
  std::vector<WayIndex> ends;
  for (WayIndex index = 0; index < graph.ways.size(); ++index) {
    open[index] = graph.ways[index].next.count;
    if (open[index] == 0) ends.push_back(index);
  }
  while (!ends.empty()) {
    Way& way = graph.ways[ends.back()];
    ends.pop_back();
    way.goes_on = false;
    for (const WayIndex before : graph.before_of(way))
      if (--open[before] == 0) ends.push_back(before);
  }
}

/// Heading at the entry of a junction and turn through it, along the whole of a connecting road.
void find_turns(LaneGraph& graph) {
  const auto at = [&](const Way& way, bool end) -> const Vec3& {
    return graph.points[way.points.first + (end ? way.points.count - 1 : 0)].tangent;
  };
  constexpr int most_sections = 100;
  // The last way of the same road in this direction, and the length of those passed.
  const auto far_end = [&](WayIndex index, bool end, double& passed_m) {
    for (int k = 0; k < most_sections; ++k) {
      const Way& way = graph.ways[index];
      const auto beyond = end ? graph.next_of(way) : graph.before_of(way);
      if (beyond.size() != 1 || graph.ways[beyond.front()].road != way.road) break;
      index = beyond.front();
      passed_m += graph.ways[index].length_m;
    }
    return index;
  };
  for (WayIndex index = 0; index < graph.ways.size(); ++index) {
    Way& way = graph.ways[index];
    if (!way.in_junction()) continue;
    way.entry = far_end(index, false, way.from_entry_m);
    way.exit = far_end(index, true, way.to_exit_m);
    const Vec3& enters = at(graph.ways[way.entry], false);
    way.enters_rad = std::atan2(enters.y, enters.x);
    way.turns_rad = turn_between(enters, at(graph.ways[way.exit], true));
  }
}

/// The point before a place, and the share of the step from there to it.
struct Between {
  std::uint32_t point = 0;
  double share = 0.0, step_m = 0.0;
};
Between between_points(const Way& way, double at_m) {
  const double step_m = way.length_m / static_cast<double>(way.points.count - 1);
  const double at = std::clamp(at_m / step_m, 0.0, static_cast<double>(way.points.count - 1));
  const auto k = std::min(static_cast<std::uint32_t>(at), way.points.count - 2);
  return {way.points.first + k, at - static_cast<double>(k), step_m};
}

}  // namespace

LaneGraph build_lane_graph(const road::RoadNetwork& network) {
  LaneGraph graph;
  list_ways(network, graph);
  for (Way& way : graph.ways) append_points(network, way, graph);
  for (Way& way : graph.ways) find_bends(way, graph);
  link_ways(network, graph);
  mark_merges(graph);
  fill_limits(graph);
  find_dead_ends(graph);
  find_turns(graph);
  find_conflicts(graph);
  find_right_of_way(network, graph);
  return graph;
}

WayIndex way_at(const LaneGraph& graph, const road::RoadNetwork& network, road::RoadIndex road, int lane, double s_m) {
  const std::size_t section = road::section_index_at(network.roads[road], s_m);
  return way_of(graph, network, road, static_cast<std::uint32_t>(section), lane);
}

PlaceOnWay place_on_way(const LaneGraph& graph, const Way& way, double at_m) {
  const auto [k, u, step] = between_points(way, at_m);
  const WayPoint &a = graph.points[k], &b = graph.points[k + 1];
  // Hermite's cubic through both points with both tangents.
  const double u2 = u * u, u3 = u2 * u;
  PlaceOnWay place;
  place.position_m = (2.0 * u3 - 3.0 * u2 + 1.0) * a.position_m + (u3 - 2.0 * u2 + u) * step * a.tangent +
                     (3.0 * u2 - 2.0 * u3) * b.position_m + (u3 - u2) * step * b.tangent;
  const Vec3 tangent = (6.0 * u2 - 6.0 * u) / step * (a.position_m - b.position_m) +
                       (3.0 * u2 - 4.0 * u + 1.0) * a.tangent + (3.0 * u2 - 2.0 * u) * b.tangent;
  const double length = glm::length(tangent);
  place.tangent = length > 1e-6 ? tangent / length : a.tangent;
  place.curvature_per_m = a.curvature_per_m + u * (b.curvature_per_m - a.curvature_per_m);
  place.width_m = a.width_m + u * (b.width_m - a.width_m);
  return place;
}

double curvature_on_way_per_m(const LaneGraph& graph, const Way& way, double at_m) {
  const auto [k, u, step] = between_points(way, at_m);
  const double from = graph.points[k].curvature_per_m;
  return from + u * (graph.points[k + 1].curvature_per_m - from);
}

AllowedSquare bend_square_at(const LaneGraph& graph, const Way& way, double at_m) {
  const auto [k, u, step] = between_points(way, at_m);
  const double low = graph.points[k].bend_m2ps2, high = graph.points[k + 1].bend_m2ps2;
  return {low + u * (high - low), (high - low) / step};
}

bool has_crossings(const LaneGraph& graph) {
  return std::ranges::any_of(graph.conflicts,
                             [](const WayConflict& conflict) { return conflict.kind == WayConflict::Kind::crossing; });
}

bool yields_to(const Way& mine, const Way& his) {
  if (mine.rank != his.rank) return mine.rank < his.rank;
  constexpr double side_rad = 0.6, oncoming_rad = 2.5, turning_rad = 0.5;
  const double keeps = mine.left_hand ? -1.0 : 1.0;
  const double relative = keeps * road::wrap_angle(his.enters_rad - mine.enters_rad);
  if (std::abs(relative) < oncoming_rad) return relative > side_rad;
  return keeps * mine.turns_rad > turning_rad && keeps * his.turns_rad <= turning_rad;
}

}  // namespace septet::traffic
