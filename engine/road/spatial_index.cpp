// The tree of bounding boxes over stretches of road; a stretch turns by at most 1/4 rad, so that
// its box is tight and Newton's method converges from its middle.
#include <algorithm>
#include <cmath>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"

namespace septet::road {
namespace {

constexpr double longest_stretch_m = 20.0, largest_turn_rad = 0.25;
constexpr std::size_t most_stretches = 1'000'000, most_stretches_of_a_road = 20'000;
// Covers the curve between the sampled points: the bulge of an arc and of a widening lane.
constexpr double box_margin_m = 2.0;

double sharpest_curvature(const PlanCurve& plan) {
  double sharpest = 0.0;
  for (const PlanRecord& record : plan.records) {
    const std::uint32_t samples = record.kind == PlanKind::cubic ? std::min(record.knot_count, 64u) : 1u;
    for (std::uint32_t i = 0; i <= samples; ++i) {
      // Just before the end, where the next record does not hold yet.
      const double ds = record.length_m * (static_cast<double>(i) / samples) * (1.0 - 1e-9);
      sharpest = std::max(sharpest, std::abs(evaluate_plan(plan, record.s_m + ds).curvature_per_m));
    }
  }
  return sharpest;
}

void cover(StretchNode& box, const Road& road, const LaneSection& section, double s) {
  const PlanPoint point = evaluate_plan(road.plan, s);
  const Vec2 left(-point.direction.y, point.direction.x);
  for (const int lane : {-section.right_count, section.left_count}) {
    const double t = outer_border_t_m(road, section, lane, s);
    const Vec2 corner = point.position_m + t * left;
    const double margin = box_margin_m + 0.1 * std::abs(t);
    box.low_m = glm::min(box.low_m, corner - margin);
    box.high_m = glm::max(box.high_m, corner + margin);
  }
}

StretchNode stretch_of(const Road& road, RoadIndex index, double s, double step) {
  StretchNode box{Vec2(1e300), Vec2(-1e300), 0, index, s, step};
  const std::size_t first = section_index_at(road, s), last = section_index_at(road, s + step);
  for (std::size_t i = first; i <= last; ++i) {
    const LaneSection& section = road.sections[i];
    const double from = std::max(section.s_m, s), to = std::min(section.s_end_m, s + step);
    for (const double at : {from, 0.5 * (from + to), to}) cover(box, road, section, at);
  }
  return box;
}

StretchNode join(const std::vector<StretchNode>& leaves, std::size_t first, std::size_t last) {
  StretchNode box{Vec2(1e300), Vec2(-1e300)};
  for (std::size_t i = first; i < last; ++i) {
    box.low_m = glm::min(box.low_m, leaves[i].low_m);
    box.high_m = glm::max(box.high_m, leaves[i].high_m);
  }
  return box;
}

/// Appends the subtree of leaves [first, last), split in the middle of its longer side.
void append_tree(std::vector<StretchNode>& tree, std::vector<StretchNode>& leaves, std::size_t first,
                 std::size_t last) {
  if (last - first == 1) {
    tree.push_back(leaves[first]);
    tree.back().skip = static_cast<std::uint32_t>(tree.size());
    return;
  }
  const StretchNode box = join(leaves, first, last);
  const std::size_t node = tree.size();
  tree.push_back(box);
  const int axis = box.high_m.x - box.low_m.x > box.high_m.y - box.low_m.y ? 0 : 1;
  const std::size_t middle = first + (last - first) / 2;
  const auto begin = leaves.begin();
  std::nth_element(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(middle),
                   begin + static_cast<std::ptrdiff_t>(last), [axis](const StretchNode& a, const StretchNode& b) {
                     const double left = a.low_m[axis] + a.high_m[axis], right = b.low_m[axis] + b.high_m[axis];
                     if (left != right) return left < right;
                     return a.road != b.road ? a.road < b.road : a.s_m < b.s_m;
                   });
  append_tree(tree, leaves, first, middle);
  append_tree(tree, leaves, middle, last);
  tree[node].skip = static_cast<std::uint32_t>(tree.size());
}

}  // namespace

void build_spatial_index(RoadNetwork& network) {
  network.stretches.clear();
  if (network.roads.empty()) return;
  const double most =
      static_cast<double>(std::clamp(most_stretches / network.roads.size(), std::size_t{1}, most_stretches_of_a_road));
  std::vector<StretchNode> leaves;
  for (RoadIndex index = 0; index < network.roads.size(); ++index) {
    const Road& road = network.roads[index];
    const double sharpest = sharpest_curvature(road.plan);
    const double longest = std::min(longest_stretch_m, largest_turn_rad / std::max(sharpest, 1e-9));
    const double count = std::clamp(std::ceil(road.length_m / longest), 1.0, most);
    const double step = road.length_m / count;
    for (double i = 0.0; i < count; i += 1.0) leaves.push_back(stretch_of(road, index, i * step, step));
  }
  network.stretches.reserve(2 * leaves.size());
  append_tree(network.stretches, leaves, 0, leaves.size());
  network.low_m = network.stretches.front().low_m;
  network.high_m = network.stretches.front().high_m;
}

}  // namespace septet::road
