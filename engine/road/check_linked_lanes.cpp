#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_position.hpp"
#include "engine/road/rule_checks.hpp"

namespace septet::road {
namespace {

constexpr double no_width_m = 1e-6, tolerated_gap_m = 0.01, tolerated_step_m = 0.05;

/// Both borders of a lane at one of its ends.
struct Edge {
  Vec3 inner_m, outer_m;
  double width_m = 0.0;
};

Edge edge_of(const CheckedFile& file, const LaneEnd& end) {
  const double s = station_of(file, end);
  const LaneBorders borders = lane_borders(file.network.roads[end.road], section_of(file, end), end.lane, s);
  const auto at = [&](double t) { return evaluate(file.network, {end.road, s, t}).position_m; };
  return {at(borders.inner_t_m), at(borders.outer_t_m), borders.width_m()};
}

bool leads_back(const CheckedFile& file, const LaneEnd& from, const LaneEnd& to) {
  const Lane& lane = lane_of(file, to);
  const auto& back = to.at_end ? lane.successors : lane.predecessors;
  return std::find(back.begin(), back.end(), from.lane) != back.end();
}

void check_both_ways(const CheckedFile& file, const LaneEnd& from, const LaneEnd& to) {
  // At the ends of a connecting road the junction has the links.
  if (from.road != to.road &&
      (file.network.roads[from.road].junction != no_index || file.network.roads[to.road].junction != no_index))
    return;
  if (leads_back(file, from, to)) return;
  file.findings.warning(
      node_of(file, to),
      fmt::format("{} goes on in {}, which does not lead back", name_of(file, from), name_of(file, to)),
      "link the lanes in both directions", "asam.net:xodr:1.4.0:road.lane.link.lanes_across_lane_sections");
}

/// Checks a lane that is linked although it has no width at that end. Returns true where the link holds.
bool check_widths(const CheckedFile& file, const LaneEnd& from, const LaneEnd& to, const Edge& from_edge,
                  const Edge& to_edge) {
  if (from_edge.width_m < no_width_m) {
    if (file.is_at_least(7)) {
      file.findings.warning(
          node_of(file, from),
          fmt::format("{} has no width there and a {}", name_of(file, from), from.at_end ? "successor" : "predecessor"),
          "remove the link",
          from.at_end ? "asam.net:xodr:1.7.0:road.lane.link.zero_width_at_end"
                      : "asam.net:xodr:1.7.0:road.lane.link.zero_width_at_start");
    }
    return false;
  }
  if (to_edge.width_m >= no_width_m) return true;
  file.findings.warning(
      node_of(file, from),
      fmt::format("{} is linked to {}, which only begins there", name_of(file, from), name_of(file, to)),
      "link only the lane that goes on", "asam.net:xodr:1.4.0:road.lane.link.new_lane_appear");
  return false;
}

void check_gap(const CheckedFile& file, const LaneEnd& from, const LaneEnd& to, const Edge& a, const Edge& b) {
  const auto gap = [&](const Vec3& inner, const Vec3& outer) {
    return std::max(glm::distance(Vec2(a.inner_m), Vec2(inner)), glm::distance(Vec2(a.outer_m), Vec2(outer)));
  };
  const double least = std::min(gap(b.inner_m, b.outer_m), gap(b.outer_m, b.inner_m));
  if (least <= tolerated_gap_m) return;
  file.findings.warning(
      node_of(file, from),
      fmt::format("the borders of {} and {} are {:.3f} m apart", name_of(file, from), name_of(file, to), least),
      "let linked lanes join", "asam.net:xodr:1.7.0:lane_smoothness.contact_point_no_horizontal_gaps");
}

/// True from one section of a road to the next, which check_steps covers.
bool are_within_a_road(const LaneEnd& from, const LaneEnd& to) {
  return from.road == to.road && from.at_end != to.at_end &&
         (from.at_end ? from.section + 1 == to.section : to.section + 1 == from.section);
}

/// Steps of lanes with heights of their own are intended.
void check_step(const CheckedFile& file, const LaneEnd& from, const LaneEnd& to, const Edge& a, const Edge& b) {
  if (are_within_a_road(from, to)) return;
  if (!lane_of(file, from).heights.empty() || !lane_of(file, to).heights.empty()) return;
  const double step = 0.5 * std::abs(a.inner_m.z + a.outer_m.z - b.inner_m.z - b.outer_m.z);
  if (step <= tolerated_step_m) return;
  file.findings.warning(
      node_of(file, from),
      fmt::format("the surface steps by {:.3f} m from {} to {}", step, name_of(file, from), name_of(file, to)),
      "let the elevations of linked lanes meet");
}

}  // namespace

void check_linked_lanes(const CheckedFile& file) {
  std::set<std::pair<LaneEnd, LaneEnd>> seen;
  visit_lane_links(file, [&](const LaneEnd& from, const LaneEnd& to, bool by_junction) {
    if (!by_junction) check_both_ways(file, from, to);
    const Edge from_edge = edge_of(file, from), to_edge = edge_of(file, to);
    if (!check_widths(file, from, to, from_edge, to_edge)) return;
    if (!seen.insert(std::minmax(from, to)).second) return;
    const bool drivable = is_drivable(lane_of(file, from).type);
    if (drivable) check_step(file, from, to, from_edge, to_edge);
    if (!file.is_at_least(7)) return;
    if (drivable) check_gap(file, from, to, from_edge, to_edge);
    if (lane_of(file, from).level != lane_of(file, to).level) {
      file.findings.warning(node_of(file, from),
                            fmt::format("{} and {} differ in level", name_of(file, from), name_of(file, to)),
                            "give linked lanes the same level", "asam.net:xodr:1.7.0:road.lane.level_true_one_side");
    }
  });
}

}  // namespace septet::road
