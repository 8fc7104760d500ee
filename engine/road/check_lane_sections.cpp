#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "engine/road/cubic_range.hpp"
#include "engine/road/rule_checks.hpp"

namespace septet::road {
namespace {

/// Checks from the centre outwards: outside a level lane there are only level lanes.
void check_levels(const CheckedFile& file, const LaneSection& section, LaneEnd at, int side, int count) {
  bool level = false;
  for (int i = 1; i <= count; ++i) {
    at.lane = side * i;
    if (level && !section.lane(at.lane).level) {
      file.findings.warning(
          node_of(file, at), fmt::format("{} is not level, but the lane inside it is", name_of(file, at)),
          "let all lanes outside a level one be level", "asam.net:xodr:1.7.0:road.lane.level_true_one_side");
      return;
    }
    level = level || section.lane(at.lane).level;
  }
}

/// The record's cubic at s, outwards of the centre line.
CubicRecord outwards_at(const CubicProfile& borders, double s) {
  const CubicRecord& record = borders[record_at(borders, s)];
  const double ds = s - record.s_m, sign = record.value(s) < 0.0 ? -1.0 : 1.0;
  return {s, sign * record.value(s), sign * record.slope(s), sign * (record.c + 3.0 * record.d * ds), sign * record.d};
}

bool overlap(const Lane& inner, const Lane& outer, const LaneSection& section) {
  constexpr double tolerated_m = 1e-6;
  std::vector<double> stations{section.s_m, section.s_end_m};
  for (const CubicProfile* profile : {&inner.borders, &outer.borders})
    for (const CubicRecord& record : *profile)
      if (record.s_m > section.s_m && record.s_m < section.s_end_m) stations.push_back(record.s_m);
  std::sort(stations.begin(), stations.end());
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    const CubicRecord a = outwards_at(inner.borders, stations[i]), b = outwards_at(outer.borders, stations[i]);
    const CubicRecord width{stations[i], b.a - a.a, b.b - a.b, b.c - a.c, b.d - a.d};
    if (value_range(width, stations[i], stations[i + 1]).low < -tolerated_m) return true;
  }
  return false;
}

/// True for a lane given by its border; where widths are given too, those count.
bool by_border(const Lane& lane) { return lane.widths.empty() && !lane.borders.empty(); }

void check_borders(const CheckedFile& file, const LaneSection& section, LaneEnd at, int side, int count) {
  for (int i = 2; i <= count; ++i) {
    const Lane &inner = section.lane(side * (i - 1)), &outer = section.lane(side * i);
    if (!by_border(inner) || !by_border(outer) || !overlap(inner, outer, section)) continue;
    at.lane = outer.id;
    file.findings.warning(
        node_of(file, at), fmt::format("the border of {} runs inside that of lane {}", name_of(file, at), inner.id),
        "let borders lie farther out lane by lane", "asam.net:xodr:1.4.0:road.lane.border.overlap_with_inner_lanes");
  }
}

/// Borders are counted from the reference line, so that an offset would be redundant.
void check_offset(const CheckedFile& file, const pugi::xml_node& road_node, const Road& road) {
  const bool borders = std::any_of(road.sections.begin(), road.sections.end(), [](const LaneSection& section) {
    return std::any_of(section.lanes.begin(), section.lanes.end(), by_border);
  });
  if (road.lane_offset.empty() || !borders) return;
  file.findings.warning(road_node.child("lanes").child("laneOffset"),
                        "the road has lanes that are given by their borders, and a lane offset",
                        "give the lanes by their widths, or leave the offset out",
                        "asam.net:xodr:1.4.0:road.lanes.lane_offset.no_offset_if_border_defined");
}

void check_access(const CheckedFile& file, const pugi::xml_node& road_node) {
  for (const auto section : road_node.child("lanes").children("laneSection"))
    for (const char* side : {"left", "right"})
      for (const auto lane : section.child(side).children("lane")) {
        std::map<double, std::string_view> rules;
        for (const auto access : lane.children("access")) {
          const std::string_view rule = access.attribute("rule").value();
          if (rule.empty()) continue;
          const auto [at, first] = rules.try_emplace(access.attribute("sOffset").as_double(), rule);
          if (first || at->second == rule) continue;
          file.findings.warning(access, "allow and deny are mixed at one place",
                                "give either what is allowed or what is denied",
                                "asam.net:xodr:1.7.0:road.lane.access.no_mix_of_deny_or_allow");
        }
      }
}

}  // namespace

void check_lane_sections(const CheckedFile& file) {
  for (RoadIndex index = 0; index < file.network.roads.size(); ++index) {
    const Road& road = file.network.roads[index];
    for (std::uint32_t i = 0; i < road.sections.size(); ++i)
      for (const int side : {1, -1}) {
        const LaneSection& section = road.sections[i];
        const int count = side > 0 ? section.left_count : section.right_count;
        const LaneEnd at{index, i, 0, false};
        if (file.is_at_least(7)) check_levels(file, section, at, side, count);
        check_borders(file, section, at, side, count);
      }
    check_offset(file, file.road_nodes[index], road);
    if (file.is_at_least(7)) check_access(file, file.road_nodes[index]);
  }
}

}  // namespace septet::road
