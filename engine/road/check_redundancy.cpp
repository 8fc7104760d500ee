#include <cmath>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "engine/road/rule_checks.hpp"

namespace septet::road {
namespace {

constexpr double same = 1e-6;
constexpr std::string_view rule = "asam.net:xodr:1.7.0:performance.avoid_redundant_info";

/// True where the second record only continues the first one's cubic.
bool goes_on(const CubicRecord& a, const CubicRecord& b) {
  const double ds = b.s_m - a.s_m;
  return std::abs(a.value(b.s_m) - b.a) < same && std::abs(a.slope(b.s_m) - b.b) < same &&
         std::abs(a.c + 3.0 * a.d * ds - b.c) < same && std::abs(a.d - b.d) < same;
}

void check_profile(const CheckedFile& file, const pugi::xml_node& node, const char* element,
                   const CubicProfile& profile) {
  std::size_t redundant = 0;
  for (std::size_t i = 1; i < profile.size(); ++i) redundant += goes_on(profile[i - 1], profile[i]);
  if (redundant == 0) return;
  file.findings.warning(
      node, fmt::format("{} of its {} records of {} go on as the one before them", redundant, profile.size(), element),
      "leave them out", rule);
}

void check_lines(const CheckedFile& file, const pugi::xml_node& road_node, const PlanCurve& plan) {
  std::size_t redundant = 0;
  for (std::size_t i = 1; i < plan.records.size(); ++i) {
    const PlanRecord &a = plan.records[i - 1], &b = plan.records[i];
    redundant += a.kind == PlanKind::line && b.kind == PlanKind::line && glm::distance(a.direction, b.direction) < same;
  }
  if (redundant == 0) return;
  file.findings.warning(road_node.child("planView"),
                        fmt::format("{} of its lines go on as the one before them", redundant), "join them", rule);
}

}  // namespace

void check_redundancy(const CheckedFile& file) {
  if (!file.is_at_least(7)) return;
  for (RoadIndex index = 0; index < file.network.roads.size(); ++index) {
    const Road& road = file.network.roads[index];
    const auto& node = file.road_nodes[index];
    check_lines(file, node, road.plan);
    check_profile(file, node.child("elevationProfile"), "elevation", road.elevation);
    check_profile(file, node.child("lateralProfile"), "superelevation", road.superelevation);
    check_profile(file, node.child("lanes"), "laneOffset", road.lane_offset);
    for (std::uint32_t i = 0; i < road.sections.size(); ++i)
      for (const Lane& lane : road.sections[i].lanes) {
        if (lane.widths.size() < 2 && lane.borders.size() < 2) continue;
        const auto lane_node = node_of(file, {index, i, lane.id, false});
        check_profile(file, lane_node, "width", lane.widths);
        check_profile(file, lane_node, "border", lane.borders);
      }
  }
}

}  // namespace septet::road
