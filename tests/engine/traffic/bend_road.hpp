#pragma once
/// Roads of one piece for traffic tests.

#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "engine/road/opendrive_reader.hpp"

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
  const auto lane = [](int id, const std::string& more, const std::string& widening) {
    return fmt::format(R"(<lane id="{}" type="driving"><width sOffset="0" a="3.5" {} d="0"/>{}</lane>)", id, widening,
                       more);
  };
  const std::string none = R"(b="0" c="0")";
  const std::string file = fmt::format(
      R"(<OpenDRIVE><header revMajor="1" revMinor="8"/><road id="1" length="{0}" junction="-1">{1}<planView>{2}</planView>)"
      R"(<elevationProfile>{3}</elevationProfile><lateralProfile>{4}</lateralProfile><lanes><laneSection s="0"><left>{5}</left>)"
      R"(<center><lane id="0" type="none"/></center><right>{6}{7}</right></laneSection></lanes></road></OpenDRIVE>)",
      text.length_m, text.type, text.geometry, text.elevation, text.superelevation, lane(1, "", none),
      lane(-1, text.lane_speed, text.widening), lane(-2, "", none));
  auto network = road::read_opendrive(file, "road.xodr");
  REQUIRE_MESSAGE(network.has_value(), describe(network.error()));
  return std::move(*network);
}

inline std::string arc(double length_m, double curvature_per_m) {
  return fmt::format(R"(<geometry s="0" x="0" y="0" hdg="0" length="{}"><arc curvature="{}"/></geometry>)", length_m,
                     curvature_per_m);
}
inline std::string spiral(double length_m, double from_per_m, double to_per_m) {
  return fmt::format(
      R"(<geometry s="0" x="0" y="0" hdg="0" length="{}"><spiral curvStart="{}" curvEnd="{}"/></geometry>)", length_m,
      from_per_m, to_per_m);
}
inline std::string straight(double length_m) {
  return fmt::format(R"(<geometry s="0" x="0" y="0" hdg="0" length="{}"><line/></geometry>)", length_m);
}

}  // namespace septet::traffic
