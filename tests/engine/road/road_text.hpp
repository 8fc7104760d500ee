#pragma once
/// The one builder of roads for tests, fuzzers and benchmarks: OpenDRIVE text of small files, written on the spot.
///
///     roads_text(SmallRoad{.id = "a", .length_m = 50.0}.text() + SmallRoad{.id = "b", .x_m = 50.0}.text())
///
/// Lengths are metres, angles radians, in the file's frame.

#include <string>
#include <string_view>

#include <fmt/format.h>

namespace septet::road {

/// A lane with a constant width. `inside`: what it has before its width; `after`: behind it.
inline std::string lane(int id, double width_m, std::string_view inside = "", std::string_view type = "driving",
                        std::string_view after = "") {
  return fmt::format(R"(<lane id="{}" type="{}">{}{}{}</lane>)", id, type, inside,
                     id == 0 ? std::string() : fmt::format(R"(<width sOffset="0" a="{}" b="0" c="0" d="0"/>)", width_m),
                     after);
}

/// Lanes of one width to the right, −1, −2, …, or to the left, from the outermost.
inline std::string right_lanes(int count, double width_m = 3.5) {
  std::string text;
  for (int i = 1; i <= count; ++i) text += lane(-i, width_m);
  return text;
}
inline std::string left_lanes(int count, double width_m = 3.5) {
  std::string text;
  for (int i = count; i > 0; --i) text += lane(i, width_m);
  return text;
}

inline std::string lane_section(std::string_view left, std::string_view right, double s_m = 0.0) {
  return fmt::format(R"(<laneSection s="{}">{}<center>{}</center><right>{}</right></laneSection>)", s_m,
                     left.empty() ? std::string() : fmt::format("<left>{}</left>", left), lane(0, 0.0), right);
}

/// A link of a road: `direction` "predecessor" or "successor", to a road's "start" or "end".
inline std::string link_to_road(std::string_view direction, std::string_view id, std::string_view contact) {
  return fmt::format(R"(<{} elementType="road" elementId="{}" contactPoint="{}"/>)", direction, id, contact);
}
inline std::string link_to_junction(std::string_view direction, std::string_view id) {
  return fmt::format(R"(<{} elementType="junction" elementId="{}"/>)", direction, id);
}

/// A connection of a junction from the end of a road's lane −1 to the start of a connecting road's.
inline std::string connection(std::string_view id, std::string_view incoming, std::string_view connecting) {
  return fmt::format(
      R"(<connection id="{}" incomingRoad="{}" connectingRoad="{}" contactPoint="start"><laneLink from="-1" to="-1"/></connection>)",
      id, incoming, connecting);
}

/// A piece of the plan view, from its place on.
inline std::string plan_piece(double s_m, double x_m, double y_m, double heading_rad, double length_m,
                              std::string_view shape = "<line/>") {
  return fmt::format("<geometry s=\"{}\" x=\"{}\" y=\"{}\" hdg=\"{}\" length=\"{}\">\n{}\n</geometry>", s_m, x_m, y_m,
                     heading_rad, length_m, shape);
}
inline std::string arc(double curvature_per_m) { return fmt::format(R"(<arc curvature="{}"/>)", curvature_per_m); }

inline std::string elevation(double z_m, double s_m = 0.0, double slope = 0.0) {
  return fmt::format(R"(<elevation s="{}" a="{}" b="{}" c="0" d="0"/>)", s_m, z_m, slope);
}

/// A file of these roads and junctions.
inline std::string roads_text(std::string_view roads, std::string_view header = "") {
  return fmt::format("<OpenDRIVE>\n<header revMajor=\"1\" revMinor=\"8\">{}</header>\n{}</OpenDRIVE>\n", header, roads);
}

/// A road with the given geometry, profiles and lanes: one of 3 m to the left and one of 3.5 m to the right, if not told.
struct SmallRoad {
  double length_m = 100.0;
  std::string attributes = {}, header = {};
  std::string geometry = {};  ///< Shape of the one piece; empty: a line.
  std::string profiles = {}, before_sections = {}, sections = {};
  std::string id = "a", junction = "-1";
  std::string link = {};  ///< Predecessor and successor.
  double x_m = 0.0, y_m = 0.0, heading_rad = 0.0;
  std::string plan = {};         ///< Several pieces, in place of the one.
  std::string before_plan = {};  ///< Types.
  std::string after_lanes = {};  ///< Objects and signals.

  /// The road alone, for a file with others.
  std::string text() const {
    const std::string linked = link.empty() ? std::string() : fmt::format("<link>{}</link>", link);
    const std::string pieces =
        plan.empty() ? plan_piece(0.0, x_m, y_m, heading_rad, length_m, geometry.empty() ? "<line/>" : geometry) : plan;
    return fmt::format(
        "<road id=\"{}\" junction=\"{}\" length=\"{}\" {}>\n{}{}<planView>{}</planView>\n{}\n<lanes>{}\n{}\n"
        "</lanes>{}\n</road>\n",
        id, junction, length_m, attributes, linked, before_plan, pieces, profiles, before_sections,
        sections.empty() ? lane_section(lane(1, 3.0), lane(-1, 3.5)) : sections, after_lanes);
  }
  std::string xml() const { return roads_text(text(), header); }
};

}  // namespace septet::road
