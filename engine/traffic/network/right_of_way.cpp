#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include "engine/traffic/network/lane_graph_parts.hpp"
#include "engine/traffic/yield_line.hpp"

namespace septet::traffic {
namespace {

constexpr double near_end_m = 30.0;  ///< Of a road: a sign or light there is for its junction.
constexpr double longest_ring_m = 450.0;
constexpr double least_roundness = 0.88;  ///< Of a circle 1, of a square 0.79.

/// Distance of a station from the road's end in the direction of travel.
double before_end_m(const road::Road& road, bool along_s, double s_m) { return along_s ? road.length_m - s_m : s_m; }

/// Signs of the Vienna Convention by the numbers of the German catalogue, which OpenDRIVE files use: 205 give way, 206
/// stop, 301 priority at the next junction, 306 priority road.
Rank rank_by_signs(const road::Road& road, bool along_s) {
  Rank rank = Rank::equal;
  for (const road::Signal& signal : road.signals) {
    if (applies_along_s(road, signal) != along_s || before_end_m(road, along_s, signal.s_m) > near_end_m) continue;
    const std::string_view type = signal.type;
    if (type == "205" || type == "206") return Rank::yields;
    if (type == "301" || type == "306") rank = Rank::priority;
  }
  return rank;
}

bool has_stop_sign(const road::Road& road, bool along_s) {
  return std::ranges::any_of(road.signals, [&](const road::Signal& signal) {
    return signal.type == "206" && applies_along_s(road, signal) == along_s &&
           before_end_m(road, along_s, signal.s_m) <= near_end_m;
  });
}

/// Where a junction orders some of its roads, one that only goes before others has priority, one that only waits yields,
/// and one that does both is between them.
Rank rank_by_order(const road::Junction& junction, road::RoadIndex road) {
  const auto is = [&](road::RoadIndex road::JunctionPriority::*side) {
    return std::ranges::find(junction.priorities, road, side) != junction.priorities.end();
  };
  const bool is_before = is(&road::JunctionPriority::high), waits = is(&road::JunctionPriority::low);
  return is_before == waits ? Rank::equal : is_before ? Rank::priority : Rank::yields;
}

/// By the incoming road's signs, else by the junction's order of incoming roads, else of connecting ones, which older files
/// name.
Rank rank_into(const road::RoadNetwork& network, const Way& way, const Way& next) {
  if (const Rank rank = rank_by_signs(network.roads[way.road], way.along_s); rank != Rank::equal) return rank;
  const road::Junction& junction = network.junctions[next.junction];
  const Rank rank = rank_by_order(junction, way.road);
  return rank != Rank::equal ? rank : rank_by_order(junction, next.road);
}

/// The next way along the ring of a roundabout: of several the one that keeps to the middle, that is, turns most to the
/// left where traffic keeps right.
WayIndex along_ring(const LaneGraph& graph, const Way& way) {
  WayIndex best = no_way;
  double most = -1e300;
  for (const WayIndex index : graph.next_of(way)) {
    const Way& next = graph.ways[index];
    const Vec3& a = graph.points[next.points.first].tangent;
    const Vec3& b = graph.points[next.points.first + next.points.count - 1].tangent;
    const double turn = std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y) * (next.left_hand ? -1.0 : 1.0);
    if (turn > most) most = turn, best = index;
  }
  return best;
}

/// The ways of a roundabout's ring through this way; empty: it is on none.
std::vector<WayIndex> ring_through(const LaneGraph& graph, WayIndex from) {
  std::vector<WayIndex> ring;
  double length_m = 0.0, twice_area_m2 = 0.0;
  bool forks = false;
  WayIndex at = from;
  do {
    const Way& way = graph.ways[at];
    ring.push_back(at);
    length_m += way.length_m;
    for (std::uint32_t k = 0; k + 1 < way.points.count; ++k) {
      const Vec3 &a = graph.points[way.points.first + k].position_m,
                 &b = graph.points[way.points.first + k + 1].position_m;
      twice_area_m2 += a.x * b.y - a.y * b.x;
    }
    forks = forks || way.next.count > 1;
    at = along_ring(graph, way);
  } while (at != no_way && at != from && length_m < longest_ring_m && ring.size() < 200);
  const double area_m2 = 0.5 * twice_area_m2 * (graph.ways[from].left_hand ? -1.0 : 1.0);
  if (at != from || !forks || 4.0 * std::numbers::pi * area_m2 < least_roundness * length_m * length_m) return {};
  return ring;
}

/// Who is on a roundabout has priority over those who come in.
void rank_roundabouts(LaneGraph& graph) {
  std::vector<std::uint8_t> on_ring(graph.ways.size(), 0);
  for (WayIndex index = 0; index < graph.ways.size(); ++index)
    if (on_ring[index] == 0)
      for (const WayIndex way : ring_through(graph, index)) on_ring[way] = 1;
  // The lanes beside them, too, where the outer ones are no ring of their own: they end at exits.
  const std::vector<std::uint8_t> is_found = on_ring;
  for (WayIndex index = 0; index < graph.ways.size(); ++index)
    if (is_found[index] != 0) {
      const auto is_beside = [&](const Way& way) {
        const Way& own = graph.ways[index];
        return way.road == own.road && way.section == own.section && way.along_s == own.along_s;
      };
      // Ways are in the order of roads and sections.
      for (WayIndex k = index; k > 0 && is_beside(graph.ways[k - 1]);) on_ring[--k] = 1;
      for (WayIndex k = index + 1; k < graph.ways.size() && is_beside(graph.ways[k]); ++k) on_ring[k] = 1;
    }
  for (WayIndex index = 0; index < graph.ways.size(); ++index)
    if (on_ring[index] != 0) {
      graph.ways[index].rank = Rank::priority;
      graph.ways[index].on_ring = true;
      for (const WayConflict& conflict : graph.conflicts_of(graph.ways[index])) {
        if (on_ring[conflict.with] != 0) continue;
        Way& beside = graph.ways[conflict.with];
        beside.rank = Rank::yields;
        const auto conflicts = graph.conflicts_of(beside);
        beside.onto_ring = std::ranges::any_of(conflicts, [&](const WayConflict& own) {
          return on_ring[own.with] != 0 && own.kind != WayConflict::Kind::diverging;
        });
        beside.on_ring = std::ranges::all_of(
            conflicts, [](const WayConflict& own) { return own.kind == WayConflict::Kind::diverging; });
      }
    }
}

}  // namespace

void find_right_of_way(const road::RoadNetwork& network, LaneGraph& graph) {
  const std::vector<YieldLine> lines = yield_lines(network);
  for (Way& way : graph.ways) {
    if (way.in_junction()) continue;
    const bool ends = std::ranges::any_of(graph.next_of(way), [&](WayIndex n) { return graph.ways[n].in_junction(); });
    if (!ends) continue;
    const road::Road& road = network.roads[way.road];
    for (const WayIndex index : graph.next_of(way)) {
      Way& next = graph.ways[index];
      if (!next.in_junction()) continue;
      if (const Rank rank = rank_into(network, way, next); rank != Rank::equal) next.rank = rank;
    }
    way.has_stop = has_stop_sign(road, way.along_s);
    for (const YieldLine& line : lines) {
      if (line.road != way.road || line.along_s != way.along_s || line.kind == YieldLine::Kind::crossing) continue;
      const double before_m = before_end_m(road, way.along_s, line.s_m);
      if (before_m > near_end_m) continue;
      way.line_before_m = std::clamp(before_m, way.line_before_m, std::max(way.line_before_m, 0.5 * way.length_m));
      way.has_light = way.has_light || line.kind == YieldLine::Kind::light;
    }
  }
  rank_roundabouts(graph);
}

}  // namespace septet::traffic
