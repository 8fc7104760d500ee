#include "engine/traffic/people/walkways.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include <glm/geometric.hpp>

#include "engine/math/plane_cells.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/traffic/people/walkway_parts.hpp"

namespace septet::traffic {
namespace {

constexpr double same_node_m = 1.2, same_level_m = 1.0;

/// Joins parts to a graph: ends that lie together are one node.
class Joiner {
 public:
  explicit Joiner(WalkwayGraph& graph) : graph_(graph) {}

  WalkIndex add(const WalkPart& part) {
    const auto index = static_cast<WalkIndex>(graph_.walks.size());
    Walk walk;
    walk.points.first = static_cast<std::uint32_t>(graph_.points.size());
    double at_m = 0.0;
    for (std::size_t k = 0; k < part.line.size(); ++k) {
      if (k > 0) at_m += glm::distance(Vec2(part.line[k].middle_m), Vec2(part.line[k - 1].middle_m));
      graph_.points.push_back(part.line[k]);
      graph_.points.back().at_m = at_m;
    }
    walk.points.count = static_cast<std::uint32_t>(part.line.size());
    walk.length_m = at_m;
    walk.begin = node_at(part.line.front().middle_m);
    walk.end = node_at(part.line.back().middle_m);
    find_directions(walk);
    graph_.walks.push_back(walk);
    return index;
  }
  /// True where a walk leads from one end of the part to the other already.
  bool is_known(const WalkPart& part) {
    const NodeIndex begin = node_at(part.line.front().middle_m), end = node_at(part.line.back().middle_m);
    return begin == end || std::ranges::any_of(graph_.walks, [&](const Walk& walk) {
             return !walk.is_crossing() &&
                    ((walk.begin == begin && walk.end == end) || (walk.begin == end && walk.end == begin));
           });
  }
  void list_ends() {
    std::vector<std::vector<WalkEnd>> ends(graph_.nodes.size());
    for (WalkIndex index = 0; index < graph_.walks.size(); ++index) {
      ends[graph_.walks[index].begin].push_back({index, true});
      ends[graph_.walks[index].end].push_back({index, false});
    }
    for (std::size_t node = 0; node < ends.size(); ++node) {
      graph_.nodes[node].ends = {static_cast<std::uint32_t>(graph_.ends.size()),
                                 static_cast<std::uint32_t>(ends[node].size())};
      graph_.ends.insert(graph_.ends.end(), ends[node].begin(), ends[node].end());
    }
  }

 private:
  static constexpr PlaneCells cells{same_node_m};

  NodeIndex node_at(const Vec3& at_m) {
    NodeIndex nearest = no_walk;
    double least_m = same_node_m;
    const Vec2 reach(same_node_m);
    cells.for_each(Vec2(at_m) - reach, Vec2(at_m) + reach, [&](std::uint64_t key) {
      const auto cell = nodes_.find(key);
      if (cell == nodes_.end()) return;
      for (const NodeIndex node : cell->second) {
        const Vec3 apart = graph_.nodes[node].at_m - at_m;
        const double d = glm::length(Vec2(apart));
        if (d < least_m && std::abs(apart.z) < same_level_m) least_m = d, nearest = node;
      }
    });
    if (nearest != no_walk) return nearest;
    nearest = static_cast<NodeIndex>(graph_.nodes.size());
    graph_.nodes.push_back({at_m, {}});
    nodes_[cells.key_at(Vec2(at_m))].push_back(nearest);
    return nearest;
  }

  void find_directions(const Walk& walk) {
    WalkPoint* points = graph_.points.data() + walk.points.first;
    for (std::size_t k = 0; k < walk.points.count; ++k) {
      const std::size_t low = k == 0 ? 0 : k - 1, high = std::min<std::size_t>(k + 1, walk.points.count - 1);
      const Vec2 way = Vec2(points[high].middle_m) - Vec2(points[low].middle_m);
      const double length = glm::length(way);
      points[k].along = length > 1e-9 ? way / length : Vec2(1.0, 0.0);
    }
  }

  WalkwayGraph& graph_;
  std::unordered_map<std::uint64_t, std::vector<NodeIndex>> nodes_;
};

/// True where a lane that is driven on lies under the middle of a part.
bool lies_on_lanes(const road::RoadNetwork& network, const WalkPart& part) {
  const Vec3& middle_m = part.line[part.line.size() / 2].middle_m;
  return std::ranges::any_of(road::roads_holding(network, Vec2(middle_m)), [&](const road::Location& there) {
    const road::RoadPosition& at = there.position;
    return road::is_drivable(road::lane_type(network, at.road, there.lanes.lane_any_type, at.s_m)) &&
           std::abs(road::evaluate(network, at).position_m.z - middle_m.z) < same_level_m;
  });
}

WalkPart part_of(const CornerPavement& corner) {
  WalkPart part;
  for (std::size_t k = 0; k < corner.kerb_m.size(); ++k) {
    WalkPoint point;
    point.middle_m = 0.5 * (corner.kerb_m[k] + corner.edge_m[k]);
    point.half_m = 0.5 * glm::distance(Vec2(corner.kerb_m[k]), Vec2(corner.edge_m[k]));
    part.line.push_back(point);
  }
  return part;
}

/// Lights for people near a crossing of their road.
void find_heads(std::span<const TrafficLight> lights, Crossing& crossing, WalkwayGraph& graph) {
  constexpr double near_m = 8.0;
  crossing.heads.first = static_cast<std::uint32_t>(graph.heads.size());
  for (std::uint32_t k = 0; k < lights.size(); ++k)
    if (lights[k].for_walkers && lights[k].road == crossing.place.road &&
        std::abs(lights[k].s_m - crossing.place.s_m) < near_m)
      graph.heads.push_back(k);
  crossing.heads.count = static_cast<std::uint32_t>(graph.heads.size()) - crossing.heads.first;
  if (crossing.heads.count > 0) crossing.kind = Crossing::Kind::light;
}

void find_posts(std::span<const WalkPost> posts, WalkwayGraph& graph) {
  constexpr PlaneCells cells{8.0};
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> near;
  for (std::uint32_t k = 0; k < posts.size(); ++k) near[cells.key_at(posts[k].at_m)].push_back(k);
  for (Walk& walk : graph.walks) {
    walk.posts.first = static_cast<std::uint32_t>(graph.posts.size());
    Vec2 low(1e300), high(-1e300);
    for (const WalkPoint& point : graph.points_of(walk)) {
      low = glm::min(low, Vec2(point.middle_m) - point.half_m);
      high = glm::max(high, Vec2(point.middle_m) + point.half_m);
    }
    cells.for_each(low, high, [&](std::uint64_t key) {
      const auto cell = near.find(key);
      if (cell == near.end()) return;
      for (const std::uint32_t k : cell->second) {
        const OnWalk on = locate_on_walk(graph, walk, posts[k].at_m, 0.5 * walk.length_m);
        const PlaceOnWalk place = place_on_walk(graph, walk, on.at_m);
        if (on.at_m > -1.0 && on.at_m < walk.length_m + 1.0 && std::abs(on.left_m) < place.half_m + posts[k].radius_m)
          graph.posts.push_back(posts[k]);
      }
    });
    walk.posts.count = static_cast<std::uint32_t>(graph.posts.size()) - walk.posts.first;
  }
}

}  // namespace

WalkwayGraph build_walkways(const road::RoadNetwork& network, const WalkwaySurroundings& surroundings) {
  WalkwayGraph graph;
  Joiner joiner(graph);
  std::vector<CrossingPart> crossings = crossing_parts(network, surroundings);
  for (const WalkPart& part : pavement_parts(network, crossings, surroundings)) {
    // Connecting roads repeat each other's pavements, and lead some across the lanes of others.
    if (part.in_junction && (joiner.is_known(part) || lies_on_lanes(network, part))) continue;
    joiner.add(part);
  }
  for (const CornerPavement& corner : surroundings.corners)
    if (const WalkPart part = part_of(corner); part.line.size() >= 2 && !joiner.is_known(part)) joiner.add(part);
  for (CrossingPart& part : crossings) {
    part.crossing.walk = joiner.add(part.walk);
    graph.walks.back().crossing = static_cast<std::uint32_t>(graph.crossings.size());
    find_heads(surroundings.lights, part.crossing, graph);
    graph.crossings.push_back(part.crossing);
  }
  joiner.list_ends();
  find_posts(surroundings.posts, graph);
  return graph;
}

PlaceOnWalk place_on_walk(const WalkwayGraph& graph, const Walk& walk, double at_m) {
  const auto points = graph.points_of(walk);
  const auto beyond = std::ranges::upper_bound(points, at_m, {}, &WalkPoint::at_m);
  const std::size_t high =
      std::clamp<std::size_t>(static_cast<std::size_t>(beyond - points.begin()), 1, points.size() - 1);
  const WalkPoint &a = points[high - 1], &b = points[high];
  const double step_m = std::max(b.at_m - a.at_m, 1e-9);
  const double share = (at_m - a.at_m) / step_m, within = std::clamp(share, 0.0, 1.0);
  PlaceOnWalk place;
  place.middle_m = a.middle_m + share * (b.middle_m - a.middle_m);
  place.middle_m.z = a.middle_m.z + within * (b.middle_m.z - a.middle_m.z);
  const Vec2 along = a.along + within * (b.along - a.along);
  const double length = glm::length(along);
  place.along = length > 1e-6 ? along / length : a.along;
  place.half_m = a.half_m + within * (b.half_m - a.half_m);
  place.rises = a.rises + within * (b.rises - a.rises);
  return place;
}

OnWalk locate_on_walk(const WalkwayGraph& graph, const Walk& walk, const Vec2& p_m, double near_m) {
  const auto points = graph.points_of(walk);
  const auto part_from = [&](std::size_t k) {
    const Vec2 a(points[k].middle_m), b(points[k + 1].middle_m);
    const Vec2 way = b - a;
    const double length = std::max(glm::length(way), 1e-9);
    double along_m = glm::dot(p_m - a, way) / length;
    if (k > 0) along_m = std::max(along_m, 0.0);
    if (k + 2 < points.size()) along_m = std::min(along_m, length);
    const Vec2 foot = a + along_m * way / length;
    const Vec2 apart = p_m - foot;
    const double side = way.x * apart.y - way.y * apart.x;
    const double distance = glm::length(apart);
    return std::pair(distance, OnWalk{points[k].at_m + along_m, side < 0.0 ? -distance : distance});
  };
  const auto beyond = std::ranges::upper_bound(points, near_m, {}, &WalkPoint::at_m);
  std::size_t k = std::clamp<std::size_t>(static_cast<std::size_t>(beyond - points.begin()), 1, points.size() - 1) - 1;
  auto best = part_from(k);
  // Downhill in both directions, with a look across one part that is no nearer.
  for (const int step : {1, -1}) {
    int missed = 0;
    for (auto next = static_cast<std::ptrdiff_t>(k) + step;
         next >= 0 && next + 1 < static_cast<std::ptrdiff_t>(points.size()) && missed < 2; next += step) {
      const auto found = part_from(static_cast<std::size_t>(next));
      if (found.first < best.first)
        best = found, missed = 0;
      else
        ++missed;
    }
  }
  return best.second;
}

}  // namespace septet::traffic
