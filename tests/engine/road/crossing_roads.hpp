#pragma once
/// Roads for the tests that lie over, under and close beside one another, written on the spot.

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tests/engine/road/road_files.hpp"

namespace septet::road {

/// A road of straight pieces and arcs from a place on, with a lane of 3.5 m to either side unless it says otherwise.
struct LaidRoad {
  std::string id;
  double x_m = 0.0, y_m = 0.0, heading_rad = 0.0;
  struct Piece {
    double length_m = 0.0, curvature_per_m = 0.0;
  };
  std::vector<Piece> pieces;
  struct Height {
    double s_m = 0.0, z_m = 0.0, slope = 0.0;
  };
  std::vector<Height> heights{{0.0, 0.0, 0.0}};
  std::string link = {}, junction = "-1";
  int lanes = 1;          ///< To either side.
  bool has_walk = false;  ///< A pavement of 2 m to either side.
  double lane_width_m = 3.5;
  bool one_way = false;  ///< Lanes to the right alone.
  std::string objects = {};

  std::string text() const {
    std::string plan;
    double s = 0.0, x = x_m, y = y_m, heading = heading_rad;
    for (const Piece& piece : pieces) {
      plan += plan_piece(s, x, y, heading, piece.length_m,
                         piece.curvature_per_m == 0.0 ? "<line/>" : arc(piece.curvature_per_m));
      const double turned = piece.length_m * piece.curvature_per_m;
      if (turned == 0.0) {
        x += piece.length_m * std::cos(heading);
        y += piece.length_m * std::sin(heading);
      } else {
        x += (std::sin(heading + turned) - std::sin(heading)) / piece.curvature_per_m;
        y -= (std::cos(heading + turned) - std::cos(heading)) / piece.curvature_per_m;
      }
      heading += turned;
      s += piece.length_m;
    }
    std::string profile;
    for (const Height& height : heights) profile += elevation(height.z_m, height.s_m, height.slope);
    std::string left = left_lanes(lanes, lane_width_m), right = right_lanes(lanes, lane_width_m);
    if (has_walk) left = lane(lanes + 1, 2.0, "", "sidewalk") + left;
    if (has_walk) right += lane(-lanes - 1, 2.0, "", "sidewalk");
    return SmallRoad{.length_m = s,
                     .profiles = fmt::format("<elevationProfile>{}</elevationProfile>", profile),
                     .sections = lane_section(one_way ? "" : left, right),
                     .id = id,
                     .junction = junction,
                     .link = link,
                     .plan = plan,
                     .after_lanes = fmt::format("<objects>{}</objects>", objects)}
        .text();
  }
};

inline RoadNetwork laid(std::initializer_list<LaidRoad> roads, std::string_view junctions = "") {
  std::string text;
  for (const LaidRoad& road : roads) text += road.text();
  return read_or_fail(roads_text(text.append(junctions)));
}

/// One road crosses another at an angle, `up_m` over it.
inline RoadNetwork two_levels(double up_m = 6.0, double angle_rad = std::numbers::pi / 2, int lanes = 1) {
  return laid({{.id = "low", .x_m = -200, .pieces = {{400, 0}}, .lanes = lanes},
               {.id = "high",
                .x_m = -200 * std::cos(angle_rad),
                .y_m = -200 * std::sin(angle_rad),
                .heading_rad = angle_rad,
                .pieces = {{400, 0}},
                .heights = {{0, up_m, 0}},
                .lanes = lanes,
                .has_walk = true}});
}

/// Two roads side by side, `apart_m` between their edges, one `up_m` higher.
inline RoadNetwork terraces(double apart_m = 6.0, double up_m = 4.0) {
  return laid({{.id = "low", .x_m = -200, .pieces = {{400, 0}}},
               {.id = "high", .x_m = -200, .y_m = 7.0 + apart_m, .pieces = {{400, 0}}, .heights = {{0, up_m, 0}}}});
}

/// Two slopes of 1:10 joined by a sharp bend of 18 m, as a road of its own.
inline RoadNetwork sharp_bend(double radius_m = 18.0, double slope = 0.1) {
  const double turn_m = radius_m * 1.2;
  LaidRoad before{.id = "1", .x_m = -150, .pieces = {{150, 0}}, .heights = {{0, 0, slope}}};
  before.link = link_to_road("successor", "2", "start");
  LaidRoad bend{.id = "2", .pieces = {{turn_m, 1.0 / radius_m}}, .heights = {{0, 150 * slope, slope}}};
  bend.link = link_to_road("predecessor", "1", "end") + link_to_road("successor", "3", "start");
  LaidRoad after{.id = "3",
                 .x_m = radius_m * std::sin(1.2),
                 .y_m = radius_m * (1.0 - std::cos(1.2)),
                 .heading_rad = 1.2,
                 .pieces = {{40, 0}, {60, 1.0 / radius_m * 0.6}},
                 .heights = {{0, (150 + turn_m) * slope, slope}}};
  after.link = link_to_road("predecessor", "2", "end");
  return laid({before, bend, after});
}

/// A ramp leaves a motorway 7 m up, falls and turns under it.
inline RoadNetwork ramp_below() {
  return laid({{.id = "motorway", .x_m = -500, .pieces = {{1000, 0}}, .heights = {{0, 7, 0}}, .lanes = 3},
               {.id = "ramp",
                .x_m = -300,
                .y_m = -12.5,
                .pieces = {{40, 0}, {60, -1.0 / 70}, {60, 0}, {190, 1.0 / 60}, {150, 0}},
                .heights = {{0, 7, 0}, {40, 7, -0.06}, {156, 0.04, 0}},
                .one_way = true}});
}

/// A ramp of some turns over itself.
inline RoadNetwork spiral(double radius_m = 25.0, double slope = 0.045) {
  return laid({{.id = "spiral",
                .pieces = {{50, 0}, {2.2 * 2 * std::numbers::pi * radius_m, 1.0 / radius_m}, {60, 0}},
                .heights = {{0, 0, 0}, {50, 0, slope}}}});
}

/// Four arms and a deck over the middle of their junction.
inline RoadNetwork junction_below_deck() {
  const auto arm = [](const char* id, double x, double y, double heading) {
    LaidRoad road{.id = id, .x_m = x, .y_m = y, .heading_rad = heading, .pieces = {{150, 0}}, .has_walk = true};
    road.link = link_to_junction("successor", "9");
    return road;
  };
  const auto through = [](const char* id, const char* from, const char* to, double x, double y, double heading,
                          double length, double curvature) {
    LaidRoad road{.id = id,
                  .x_m = x,
                  .y_m = y,
                  .heading_rad = heading,
                  .pieces = {{length, curvature}},
                  .junction = "9",
                  .has_walk = false};
    road.link = link_to_road("predecessor", from, "end") + link_to_road("successor", to, "end");
    return road;
  };
  constexpr double quarter = std::numbers::pi / 2;
  std::string connections;
  int number = 0;
  for (const auto& [from, way] : {std::pair{"1", "11"}, {"2", "12"}, {"1", "13"}, {"3", "14"}})
    connections += connection(fmt::format("{}", number++), from, way);
  return laid({arm("1", -165, 0, 0),
               arm("2", 0, -165, quarter),
               arm("3", 165, 0, 2 * quarter),
               arm("4", 0, 165, -quarter),
               through("11", "1", "3", -15, 0, 0, 30, 0),
               through("12", "2", "4", 0, -15, quarter, 30, 0),
               through("13", "1", "4", -15, 0, 0, 15 * quarter, 1.0 / 15),
               through("14", "3", "2", 15, 0, 2 * quarter, 15 * quarter, 1.0 / 15),
               {.id = "deck",
                .x_m = -140,
                .y_m = -140,
                .heading_rad = quarter / 2,
                .pieces = {{396, 0}},
                .heights = {{0, 6.5, 0}}}},
              fmt::format(R"(<junction id="9" name="">{}</junction>)", connections));
}

}  // namespace septet::road
