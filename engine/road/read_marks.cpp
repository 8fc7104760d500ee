#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "engine/road/road_elements.hpp"
#include "engine/road/road_limits.hpp"

namespace septet::road {
namespace {

// Where the file gives no lines: a broken line is painted 3 m in 12, double lines lie one width apart.
constexpr double dash_m = 3.0, gap_m = 9.0;
constexpr double standard_width_m = 0.12, bold_width_m = 0.25;

template <class Value, std::size_t size>
using Words = std::array<std::pair<std::string_view, Value>, size>;

constexpr Words<RoadMarkType, 12> type_words{{{"none", RoadMarkType::none},
                                              {"solid", RoadMarkType::solid},
                                              {"broken", RoadMarkType::broken},
                                              {"solid solid", RoadMarkType::solid_solid},
                                              {"solid broken", RoadMarkType::solid_broken},
                                              {"broken solid", RoadMarkType::broken_solid},
                                              {"broken broken", RoadMarkType::broken_broken},
                                              {"botts dots", RoadMarkType::botts_dots},
                                              {"grass", RoadMarkType::grass},
                                              {"curb", RoadMarkType::curb},
                                              {"edge", RoadMarkType::edge},
                                              {"custom", RoadMarkType::custom}}};
constexpr Words<RoadMarkColor, 9> color_words{{{"standard", RoadMarkColor::white},
                                               {"white", RoadMarkColor::white},
                                               {"yellow", RoadMarkColor::yellow},
                                               {"blue", RoadMarkColor::blue},
                                               {"green", RoadMarkColor::green},
                                               {"red", RoadMarkColor::red},
                                               {"orange", RoadMarkColor::orange},
                                               {"violet", RoadMarkColor::violet},
                                               {"black", RoadMarkColor::black}}};
constexpr Words<LaneChange, 4> change_words{{{"both", LaneChange::both},
                                             {"increase", LaneChange::increase},
                                             {"decrease", LaneChange::decrease},
                                             {"none", LaneChange::none}}};

/// The value of a word; an unknown one is a warning and the fallback.
template <class Value, std::size_t size>
Value word_value(XmlFindings& findings, const pugi::xml_node& node, const char* attribute,
                 const Words<Value, size>& words, Value fallback) {
  const std::string_view text = node.attribute(attribute).value();
  if (text.empty()) return fallback;
  for (const auto& [word, value] : words) {
    if (word == text) return value;
  }
  findings.warning(
      node, fmt::format("{}=\"{}\" is unknown; it is taken as {}", attribute, text.substr(0, 40), words[0].first),
      "use a word of the standard");
  return fallback;
}

RoadMarkLine solid_line(double t_offset, double width) { return {0.0, 0.0, t_offset, 0.0, width}; }
RoadMarkLine broken_line(double t_offset, double width) { return {dash_m, gap_m, t_offset, 0.0, width}; }

/// The lines of a type; the first word of a double line is the inner one (of the centre lane: the left one).
std::vector<RoadMarkLine> lines_of(RoadMarkType type, double width, int lane) {
  const double first = lane > 0 ? -width : width;
  switch (type) {
    case RoadMarkType::solid:
    case RoadMarkType::custom:
      return {solid_line(0.0, width)};
    case RoadMarkType::broken:
      return {broken_line(0.0, width)};
    case RoadMarkType::solid_solid:
      return {solid_line(first, width), solid_line(-first, width)};
    case RoadMarkType::solid_broken:
      return {solid_line(first, width), broken_line(-first, width)};
    case RoadMarkType::broken_solid:
      return {broken_line(first, width), solid_line(-first, width)};
    case RoadMarkType::broken_broken:
      return {broken_line(first, width), broken_line(-first, width)};
    case RoadMarkType::botts_dots:
      return {{width, 1.0, 0.0, 0.0, width}};
    case RoadMarkType::none:
    case RoadMarkType::grass:
    case RoadMarkType::curb:
    case RoadMarkType::edge:
      break;
  }
  return {};
}

/// Appends a line to the mark, unless its dashes are too short to be painted.
void read_line(XmlFindings& findings, const pugi::xml_node& node, bool once, RoadMark& mark) {
  RoadMarkLine line;
  line.length_m = findings.amount_or(node, "length", 0.0, longest_road_m);
  line.space_m = once ? 0.0 : findings.amount_or(node, "space", 0.0, longest_road_m);
  line.t_offset_m = findings.number_or(node, "tOffset", 0.0, widest_m);
  line.s_offset_m = findings.number_or(node, "sOffset", 0.0, longest_road_m);
  const double own_width = findings.amount_or(node, "width", 0.0, widest_m);
  line.width_m = own_width > 0.0 ? own_width : mark.width_m;
  line.once = once;
  if (line.space_m > 0.0 && line.length_m < shortest_dash_m) {
    findings.warning(node, fmt::format("its dashes are {} m long; it is left out", line.length_m),
                     fmt::format("give a length of at least {} m, or no space", shortest_dash_m));
    return;
  }
  mark.lines.push_back(line);
}

}  // namespace

std::vector<RoadMark> read_marks(XmlFindings& findings, const pugi::xml_node& lane_node, const LaneSection& section) {
  std::vector<RoadMark> marks;
  const int lane = lane_node.attribute("id").as_int();
  for (const auto node : lane_node.children("roadMark")) {
    RoadMark mark;
    mark.s_m = section.s_m + findings.number_or(node, "sOffset", 0.0);
    mark.type = word_value(findings, node, "type", type_words, RoadMarkType::none);
    mark.color = word_value(findings, node, "color", color_words, RoadMarkColor::white);
    mark.lane_change = word_value(findings, node, "laneChange", change_words, LaneChange::both);
    mark.bold = std::string_view(node.attribute("weight").value()) == "bold";
    const double width = findings.amount_or(node, "width", 0.0, widest_m);
    mark.width_m = width > 0.0 ? width : (mark.bold ? bold_width_m : standard_width_m);
    mark.height_m = findings.number_or(node, "height", 0.0, tallest_m);
    for (const auto line : node.child("type").children("line")) read_line(findings, line, false, mark);
    for (const auto line : node.child("explicit").children("line")) read_line(findings, line, true, mark);
    if (mark.type == RoadMarkType::none) mark.lines.clear();
    if (mark.lines.empty()) mark.lines = lines_of(mark.type, mark.width_m, lane);
    if (!marks.empty() && mark.s_m < marks.back().s_m) {
      findings.warning(node, "its sOffset lies before that of the mark before it", "sort the marks by sOffset");
    }
    marks.push_back(std::move(mark));
  }
  std::stable_sort(marks.begin(), marks.end(), [](const RoadMark& a, const RoadMark& b) { return a.s_m < b.s_m; });
  for (std::size_t i = 0; i < marks.size(); ++i) {
    marks[i].s_end_m = i + 1 < marks.size() ? marks[i + 1].s_m : std::max(marks[i].s_m, section.s_end_m);
  }
  return marks;
}

}  // namespace septet::road
