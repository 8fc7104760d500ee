#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "engine/road/cubic_range.hpp"
#include "engine/road/road_elements.hpp"
#include "engine/road/road_limits.hpp"

namespace septet::road {
namespace {

constexpr double tolerated_negative_m = 0.01;

std::vector<int> read_links(XmlFindings& findings, const pugi::xml_node& lane_node, const char* element) {
  std::vector<int> ids;
  for (const auto node : lane_node.child("link").children(element)) {
    if (const auto id = findings.integer(node, "id")) ids.push_back(*id);
  }
  return ids;
}

LaneType read_type(XmlFindings& findings, const pugi::xml_node& node, int id) {
  const std::string_view text = node.attribute("type").value();
  // The centre lane needs no type.
  if (text.empty() && id == 0) return LaneType::none;
  for (int i = 0; i < static_cast<int>(LaneType::other); ++i) {
    if (text == name_of(static_cast<LaneType>(i))) return static_cast<LaneType>(i);
  }
  // Names of older editions.
  if (text == "mwyEntry") return LaneType::entry;
  if (text == "mwyExit") return LaneType::exit;
  if (text == "roadMark" || text == "special1" || text == "special2" || text == "special3") return LaneType::other;
  if (text == "shared" || text == "walking") return LaneType::sidewalk;
  findings.warning(node,
                   text.empty() ? fmt::format("lane {} has no type", id)
                                : fmt::format("lane type \"{}\" is unknown", text.substr(0, 40)),
                   "use a type of the standard");
  return LaneType::other;
}

LaneDirection read_direction(const pugi::xml_node& node) {
  const std::string_view text = node.attribute("direction").value();
  if (text == "reversed") return LaneDirection::reversed;
  return text == "both" ? LaneDirection::both : LaneDirection::standard;
}

void check_widths(XmlFindings& findings, const pugi::xml_node& node, const Lane& lane, double s_end) {
  const bool by_border = lane.widths.empty();
  const CubicProfile& profile = by_border ? lane.borders : lane.widths;
  visit_records(profile, s_end, [&](const CubicRecord& record, double end) {
    const ValueRange range = value_range(record, record.s_m, end);
    if (!(range.magnitude() <= widest_m)) {
      findings.error(node,
                     fmt::format("lane {} is {:.4g} m wide from s={:.3f}", lane.id, range.magnitude(), record.s_m),
                     "check its polynomial");
    } else if (!by_border && range.low < -tolerated_negative_m) {
      const std::string what =
          fmt::format("the width of lane {} from s={:.3f} is negative ({:.4g} m)", lane.id, record.s_m, range.low);
      if (record.a < -tolerated_negative_m) {
        findings.error(node, what, "give a width of at least 0 m");
      } else {
        findings.warning(node, what + "; it is taken as 0", "give a width of at least 0 m");
      }
    }
  });
}

Lane read_lane(XmlFindings& findings, const pugi::xml_node& node, const LaneSection& section, int id) {
  Lane lane;
  lane.id = id;
  lane.type = read_type(findings, node, id);
  lane.direction = read_direction(node);
  lane.level = node.attribute("level").as_bool();
  lane.predecessors = read_links(findings, node, "predecessor");
  lane.successors = read_links(findings, node, "successor");
  lane.marks = read_marks(findings, node, section);
  if (id == 0) return lane;
  lane.widths = read_profile(findings, node, "width", "sOffset", section.s_m);
  lane.borders = read_profile(findings, node, "border", "sOffset", section.s_m);
  if (lane.widths.empty() && lane.borders.empty()) {
    findings.warning(node, fmt::format("lane {} has no width; it is taken as 0", id), "add a width or a border");
  }
  check_widths(findings, node, lane, section.s_end_m);
  for (const auto height : node.children("height")) {
    lane.heights.push_back({section.s_m + findings.number_or(height, "sOffset", 0.0),
                            findings.number_or(height, "inner", 0.0, tallest_m),
                            findings.number_or(height, "outer", 0.0, tallest_m)});
  }
  for (const auto speed : node.children("speed")) {
    lane.speeds.push_back({section.s_m + findings.number_or(speed, "sOffset", 0.0), read_speed(findings, speed)});
  }
  for (const auto material : node.children("material")) {
    lane.materials.push_back(
        {section.s_m + findings.number_or(material, "sOffset", 0.0), read_material(findings, material)});
  }
  const auto by_station = [](const auto& a, const auto& b) { return a.s_m < b.s_m; };
  std::stable_sort(lane.heights.begin(), lane.heights.end(), by_station);
  std::stable_sort(lane.speeds.begin(), lane.speeds.end(), by_station);
  std::stable_sort(lane.materials.begin(), lane.materials.end(), by_station);
  return lane;
}

/// The lanes of one side, from the centre outwards; their ids must run sign·1, sign·2, …
std::vector<Lane> read_side(XmlFindings& findings, const pugi::xml_node& side_node, const LaneSection& section,
                            int sign) {
  std::vector<Lane> lanes;
  for (const auto node : side_node.children("lane")) {
    const auto id = findings.integer(node, "id");
    if (!id) continue;
    if (*id * sign <= 0) {
      findings.error(node, fmt::format("lane {} stands on the wrong side", *id),
                     "left lanes are above 0, right lanes below");
      continue;
    }
    if (lanes.size() == static_cast<std::size_t>(most_lanes_of_a_side)) {
      findings.error(side_node, fmt::format("there are more than {} lanes", most_lanes_of_a_side),
                     "split the road into several side by side");
      break;
    }
    lanes.push_back(read_lane(findings, node, section, *id));
  }
  std::stable_sort(lanes.begin(), lanes.end(),
                   [sign](const Lane& a, const Lane& b) { return a.id * sign < b.id * sign; });
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const int expected = sign * static_cast<int>(i + 1);
    if (lanes[i].id == expected) continue;
    findings.error(side_node, fmt::format("lane {} stands where lane {} is due", lanes[i].id, expected),
                   "number the lanes of a side without a gap from the centre outwards, each once");
    lanes[i].id = expected;
  }
  return lanes;
}

/// Continues the other side of the section before, for a section that gives one side only.
std::vector<Lane> continue_side(LaneSection& before, const LaneSection& section, int sign) {
  std::vector<Lane> lanes;
  const int count = sign > 0 ? before.left_count : before.right_count;
  for (int i = 1; i <= count; ++i) {
    Lane& original = before.lanes[static_cast<std::size_t>(before.left_count - sign * i)];
    Lane lane = original;
    lane.predecessors = {lane.id};
    original.successors = {lane.id};
    const auto ended = [&](const RoadMark& mark) { return mark.s_end_m < section.s_m; };
    std::erase_if(lane.marks, ended);
    for (RoadMark& mark : lane.marks) mark.s_m = std::max(mark.s_m, section.s_m);
    if (!lane.marks.empty()) lane.marks.back().s_end_m = section.s_end_m;
    lanes.push_back(std::move(lane));
  }
  return lanes;
}

void read_section(XmlFindings& findings, const pugi::xml_node& node, LaneSection& section, LaneSection* before) {
  std::vector<Lane> left = read_side(findings, node.child("left"), section, 1);
  std::vector<Lane> right = read_side(findings, node.child("right"), section, -1);
  if (before != nullptr && node.attribute("singleSide").as_bool()) {
    if (!node.child("left")) left = continue_side(*before, section, 1);
    if (!node.child("right")) right = continue_side(*before, section, -1);
  }
  const auto centre = node.child("center").child("lane");
  if (!centre) findings.warning(node, "the lane section has no centre lane", "add <center><lane id=\"0\" …/></center>");
  section.left_count = static_cast<int>(left.size());
  section.right_count = static_cast<int>(right.size());
  section.lanes.assign(std::make_move_iterator(left.rbegin()), std::make_move_iterator(left.rend()));
  section.lanes.push_back(centre ? read_lane(findings, centre, section, 0) : Lane{});
  section.lanes.insert(section.lanes.end(), std::make_move_iterator(right.begin()),
                       std::make_move_iterator(right.end()));
}

}  // namespace

SurfaceMaterial read_material(XmlFindings& findings, const pugi::xml_node& node) {
  SurfaceMaterial material;
  material.surface = node.attribute("surface").value();
  material.friction = findings.amount_or(node, "friction", 0.0, largest_coefficient);
  material.roughness = findings.amount_or(node, "roughness", 0.0, largest_coefficient);
  return material;
}

double read_speed(XmlFindings& findings, const pugi::xml_node& node) {
  const std::string_view max = node.attribute("max").value();
  if (max == "no limit" || max == "undefined") return 0.0;
  const double value = findings.amount_or(node, "max", 0.0, fastest);
  const std::string_view unit = node.attribute("unit").value();
  if (unit == "km/h") return value / 3.6;
  if (unit == "mph") return value * 0.44704;
  if (!unit.empty() && unit != "m/s") {
    findings.warning(node, fmt::format("unit \"{}\" is unknown; it is taken as m/s", unit.substr(0, 40)),
                     "use m/s, km/h or mph");
  }
  return value;
}

void read_lanes(XmlFindings& findings, const pugi::xml_node& road_node, Road& road) {
  const auto lanes = road_node.child("lanes");
  road.lane_offset = read_profile(findings, lanes, "laneOffset", "s", 0.0);
  visit_records(road.lane_offset, road.length_m, [&](const CubicRecord& record, double end) {
    const double reach = value_range(record, record.s_m, end).magnitude();
    if (reach <= widest_m) return;
    findings.error(lanes, fmt::format("the lane offset from s={} reaches {:.4g} m", record.s_m, reach),
                   fmt::format("keep it within ±{} m", widest_m));
  });
  std::vector<pugi::xml_node> nodes;
  for (const auto node : lanes.children("laneSection")) {
    const double s = findings.number(node, "s");
    if (!road.sections.empty() && s <= road.sections.back().s_m) {
      findings.error(node, fmt::format("s={} does not lie after the section before it", s),
                     "sort the sections by s, each once");
      continue;
    }
    if (road.sections.empty() && s != 0.0) {
      findings.warning(node, fmt::format("the first lane section begins at s={}; it is taken as 0", s),
                       "let it begin at 0");
    }
    if (s > road.length_m) {
      findings.warning(node, fmt::format("s={} lies beyond the road's end at {}; it is left out", s, road.length_m),
                       "let the section begin on the road");
      continue;
    }
    LaneSection section;
    section.s_m = road.sections.empty() ? 0.0 : s;
    road.sections.push_back(std::move(section));
    nodes.push_back(node);
  }
  if (road.sections.empty()) {
    findings.error(road_node, fmt::format("road {} has no lane section", road.id),
                   "add lanes with at least one laneSection");
    return;
  }
  for (std::size_t i = 0; i < road.sections.size(); ++i) {
    road.sections[i].s_end_m = i + 1 < road.sections.size() ? road.sections[i + 1].s_m : road.length_m;
    read_section(findings, nodes[i], road.sections[i], i > 0 ? &road.sections[i - 1] : nullptr);
  }
  road.flat = road.shapes.empty() && road.crossfall_left.empty() && road.crossfall_right.empty();
  for (const LaneSection& section : road.sections) {
    for (const Lane& lane : section.lanes) {
      road.flat = road.flat && lane.heights.empty();
      road.has_materials = road.has_materials || !lane.materials.empty();
    }
  }
}

}  // namespace septet::road
