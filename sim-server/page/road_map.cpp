#include "sim-server/page/road_map.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_position.hpp"

namespace septet::page {
namespace {

constexpr double step_m = 4.0;
/// A line is simplified in stretches of this many points: one of n points could take n² otherwise.
constexpr std::size_t stretch_points = 512;

double distance_m(const Vec2& point, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double square = glm::dot(along, along);
  const double at = square > 0.0 ? std::clamp(glm::dot(point - a, along) / square, 0.0, 1.0) : 0.0;
  return glm::length(point - (a + at * along));
}

void keep_corners(const std::vector<Vec2>& points, std::size_t first, std::size_t last, double tolerance_m,
                  std::vector<bool>& keep) {
  std::vector<std::pair<std::size_t, std::size_t>> due{{first, last}};
  while (!due.empty()) {
    const auto [from, to] = due.back();
    due.pop_back();
    std::size_t farthest = from;
    double far_m = tolerance_m;
    for (std::size_t i = from + 1; i < to; ++i)
      if (const double m = distance_m(points[i], points[from], points[to]); m > far_m) {
        far_m = m;
        farthest = i;
      }
    if (farthest == from) continue;
    keep[farthest] = true;
    due.emplace_back(from, farthest);
    due.emplace_back(farthest, to);
  }
}

/// The borders of one lane section, from its beginning to the next one's.
class SectionLines {
 public:
  SectionLines(const road::RoadNetwork& network, road::RoadIndex index, std::size_t section)
      : network_(network), index_(index), section_(network.roads[index].sections[section]) {
    const auto& road = network.roads[index];
    begin_m_ = section_.s_m;
    end_m_ = section + 1 < road.sections.size() ? road.sections[section + 1].s_m : road.length_m;
  }

  /// The outer border of a lane; of lane 0 the centre line.
  std::vector<Vec2> border(int lane) const {
    const auto& road = network_.roads[index_];
    const auto steps = static_cast<std::size_t>(std::clamp(std::ceil((end_m_ - begin_m_) / step_m), 1.0, 1e6));
    std::vector<Vec2> points;
    points.reserve(steps + 1);
    for (std::size_t i = 0; i <= steps; ++i) {
      const double s_m = begin_m_ + (end_m_ - begin_m_) * static_cast<double>(i) / static_cast<double>(steps);
      const double t_m = road::outer_border_t_m(road, section_, lane, s_m);
      const Vec3 at = road::evaluate(network_, {index_, s_m, t_m}).position_m;
      if (std::isfinite(at.x) && std::isfinite(at.y)) points.push_back({at.x, at.y});
    }
    return points;
  }

  const road::LaneSection& section() const { return section_; }

 private:
  const road::RoadNetwork& network_;
  road::RoadIndex index_;
  const road::LaneSection& section_;
  double begin_m_ = 0.0, end_m_ = 0.0;
};

bool is_paved(road::LaneType type) {
  using enum road::LaneType;
  return road::is_drivable(type) || type == shoulder || type == stop || type == bus || type == taxi || type == hov ||
         type == parking || type == restricted || type == road_works;
}

/// One side of the centre line: its lanes from the inside out, as stretches of adjacent paved lanes.
void add_side(const SectionLines& lines, int sign, RoadMap& map, std::vector<RoadMap::Shape>& painted) {
  std::vector<const road::Lane*> lanes;
  for (const auto& lane : lines.section().lanes)
    if (lane.id * sign > 0) lanes.push_back(&lane);
  std::ranges::sort(lanes, {}, [](const road::Lane* lane) { return std::abs(lane->id); });
  for (std::size_t i = 0; i < lanes.size();) {
    if (!is_paved(lanes[i]->type)) {
      ++i;
      continue;
    }
    const std::size_t first = i;
    while (i < lanes.size() && is_paved(lanes[i]->type)) ++i;
    const auto inner = lines.border(lanes[first]->id - sign);
    auto outline = inner;
    painted.push_back({RoadMap::Kind::edge, inner});
    for (std::size_t j = first; j < i; ++j) {
      auto outer = lines.border(lanes[j]->id);
      if (j + 1 == i) std::ranges::reverse_copy(outer, std::back_inserter(outline));
      painted.push_back({j + 1 == i ? RoadMap::Kind::edge : RoadMap::Kind::line, std::move(outer)});
    }
    map.shapes.push_back({RoadMap::Kind::carriageway, std::move(outline)});
  }
}

}  // namespace

std::vector<Vec2> simplified(const std::vector<Vec2>& points_m, double tolerance_m) {
  if (points_m.size() < 3) return points_m;
  std::vector<bool> keep(points_m.size(), false);
  keep.front() = keep.back() = true;
  for (std::size_t first = 0; first + 1 < points_m.size(); first += stretch_points) {
    const std::size_t last = std::min(first + stretch_points, points_m.size() - 1);
    keep[last] = true;
    keep_corners(points_m, first, last, tolerance_m, keep);
  }
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < points_m.size(); ++i)
    if (keep[i]) kept.push_back(points_m[i]);
  return kept;
}

RoadMap road_map(const road::RoadNetwork& network, double tolerance_m, std::size_t most_points) {
  RoadMap exact;
  std::vector<RoadMap::Shape> painted;
  for (road::RoadIndex road = 0; road < network.roads.size(); ++road)
    for (std::size_t section = 0; section < network.roads[road].sections.size(); ++section) {
      const SectionLines lines(network, road, section);
      for (const int sign : {1, -1}) add_side(lines, sign, exact, painted);
    }
  std::ranges::move(painted, std::back_inserter(exact.shapes));
  for (;; tolerance_m *= 2.0) {
    RoadMap map;
    std::size_t points = 0;
    for (const auto& shape : exact.shapes) {
      map.shapes.push_back({shape.kind, simplified(shape.points_m, tolerance_m)});
      points += map.shapes.back().points_m.size();
    }
    // The part that cannot become coarser is cut off.
    if (points <= most_points || tolerance_m > 100.0) {
      if (points > most_points) map.shapes.resize(std::min(map.shapes.size(), most_points / 64));
      return map;
    }
  }
}

}  // namespace septet::page
