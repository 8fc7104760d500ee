#pragma once
/// Roads of one piece for traffic tests.

#include <string>

#include <fmt/format.h>

#include "tests/engine/road/road_files.hpp"

namespace septet::traffic {

/// Parts of a road in OpenDRIVE's own words; empty: none.
struct RoadText {
  std::string geometry;  ///< For the plan view.
  double length_m = 0.0;
  std::string type = {};  ///< <type> elements.
  std::string elevation = {}, superelevation = {};
  std::string lane_speed = {};              ///< In lane −1.
  std::string widening = R"(b="0" c="0")";  ///< Of the lane −1, whose width is 3.5 m at its begin.
};

/// One lane to the left, two to the right of the reference line, 3.5 m each.
inline road::RoadNetwork read_road(const RoadText& text) {
  const std::string first = fmt::format(
      R"(<lane id="-1" type="driving"><width sOffset="0" a="3.5" {} d="0"/>{}</lane>)", text.widening, text.lane_speed);
  return road::read_or_fail(road::SmallRoad{
      .length_m = text.length_m,
      .profiles = fmt::format("<elevationProfile>{}</elevationProfile><lateralProfile>{}</lateralProfile>",
                              text.elevation, text.superelevation),
      .sections = road::lane_section(road::lane(1, 3.5), first + road::lane(-2, 3.5)),
      .id = "1",
      .plan = text.geometry,
      .before_plan = text.type}
                                .xml());
}

inline std::string arc(double length_m, double curvature_per_m) {
  return road::plan_piece(0, 0, 0, 0, length_m, road::arc(curvature_per_m));
}
inline std::string spiral(double length_m, double from_per_m, double to_per_m) {
  return road::plan_piece(0, 0, 0, 0, length_m,
                          fmt::format(R"(<spiral curvStart="{}" curvEnd="{}"/>)", from_per_m, to_per_m));
}
inline std::string straight(double length_m) { return road::plan_piece(0, 0, 0, 0, length_m); }

}  // namespace septet::traffic
