#pragma once
/// A crossing of four arms, written as OpenDRIVE: each arm 200 m long, one lane for each direction, 3.5 m wide, all
/// twelve connections. The arms end open.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "engine/road/opendrive_reader.hpp"
#include "engine/traffic/network/lane_graph.hpp"

namespace septet::traffic {

/// From the crossing's middle to where an arm ends, and the radius of the lane's middle in a right turn.
inline constexpr double arm_end_m = 10.0, lane_m = 3.5, right_turn_m = arm_end_m - 0.5 * lane_m;

/// Signs: give way (or stop) on the arms of west and east, priority on those of south and north; or lights on all arms.
enum class Posted : std::uint8_t { nothing, signs, stop_signs, lights };

inline road::RoadNetwork crossing(bool left_hand = false, Posted posted = Posted::nothing) {
  struct Arm {
    const char* name;
    double heading;  ///< Of the drive towards the middle.
  };
  constexpr double quarter = 0.5 * std::numbers::pi, arm_m = 200.0;
  const std::array<Arm, 4> arms{{{"south", quarter}, {"east", 2.0 * quarter}, {"north", -quarter}, {"west", 0.0}}};
  const char* rule = left_hand ? "LHT" : "RHT";
  // Lane of the traffic along s, and the other one.
  const int along = left_hand ? 1 : -1;
  const auto lane = [](int id, int before, int after) {
    const std::string link =
        before == 0 ? std::string()
                    : fmt::format("<link><predecessor id=\"{}\"/><successor id=\"{}\"/></link>", before, after);
    return fmt::format(
        "<lane id=\"{}\" type=\"driving\" level=\"false\">{}<width sOffset=\"0\" a=\"{}\" b=\"0\" "
        "c=\"0\" d=\"0\"/></lane>",
        id, link, lane_m);
  };
  const std::string centre = "<center><lane id=\"0\" type=\"none\" level=\"false\"/></center>";
  std::string text = "<OpenDRIVE><header revMajor=\"1\" revMinor=\"8\" name=\"crossing\"/>";
  for (const Arm& arm : arms) {
    const double x = -(arm_m + arm_end_m) * std::cos(arm.heading), y = -(arm_m + arm_end_m) * std::sin(arm.heading);
    std::string sign;
    if (posted != Posted::nothing) {
      const bool minor = arm.heading == 0.0 || arm.heading == 2.0 * quarter, lights = posted == Posted::lights;
      sign = fmt::format(
          "<signals><signal s=\"{}\" t=\"-5\" id=\"s-{}\" name=\"\" dynamic=\"{}\" orientation=\"+\" zOffset=\"2\" "
          "country=\"{}\" type=\"{}\" subtype=\"-1\" height=\"0.6\" width=\"0.6\"/></signals>",
          arm_m - 2.0, arm.name, lights ? "yes" : "no", lights ? "OpenDRIVE" : "DE",
          lights                         ? "1000001"
          : !minor                       ? "301"
          : posted == Posted::stop_signs ? "206"
                                         : "205");
    }
    text += fmt::format(
        "<road id=\"{}\" name=\"\" length=\"{}\" junction=\"-1\" rule=\"{}\"><link><successor "
        "elementType=\"junction\" elementId=\"j\"/></link><type s=\"0\" type=\"town\"><speed max=\"50\" "
        "unit=\"km/h\"/></type><planView><geometry s=\"0\" x=\"{}\" y=\"{}\" hdg=\"{}\" "
        "length=\"{}\"><line/></geometry></planView><lanes><laneSection s=\"0\"><left>{}</left>{}"
        "<right>{}</right></laneSection></lanes>{}</road>",
        arm.name, arm_m, rule, x, y, arm.heading, arm_m, lane(1, 0, 0), centre, lane(-1, 0, 0), sign);
  }
  std::string connections;
  for (std::size_t i = 0; i < arms.size(); ++i)
    for (std::size_t j = 0; j < arms.size(); ++j) {
      if (i == j) continue;
      const Arm &from = arms[i], &to = arms[j];
      // The reference lines of two arms meet in the middle: a line, or an arc that touches both.
      const double x = -arm_end_m * std::cos(from.heading), y = -arm_end_m * std::sin(from.heading);
      const double turn = std::remainder(to.heading + std::numbers::pi - from.heading, 2.0 * std::numbers::pi);
      const bool straight = std::abs(turn) < 0.1;
      const double length = straight ? 2.0 * arm_end_m : quarter * arm_end_m;
      const std::string shape =
          straight ? std::string("<line/>") : fmt::format("<arc curvature=\"{}\"/>", turn / length);
      const std::string id = fmt::format("{}-{}", from.name, to.name);
      text += fmt::format(
          "<road id=\"{}\" name=\"\" length=\"{}\" junction=\"j\" rule=\"{}\"><link><predecessor elementType=\"road\" "
          "elementId=\"{}\" contactPoint=\"end\"/><successor elementType=\"road\" elementId=\"{}\" "
          "contactPoint=\"end\"/></link><planView><geometry s=\"0\" x=\"{}\" y=\"{}\" hdg=\"{}\" "
          "length=\"{}\">{}</geometry></planView><lanes><laneSection s=\"0\">{}{}{}</laneSection></lanes></road>",
          id, length, rule, from.name, to.name, x, y, from.heading, length, shape,
          left_hand ? fmt::format("<left>{}</left>", lane(1, 1, -1)) : std::string(), centre,
          left_hand ? std::string() : fmt::format("<right>{}</right>", lane(-1, -1, 1)));
      connections += fmt::format(
          "<connection id=\"{}\" incomingRoad=\"{}\" connectingRoad=\"{}\" "
          "contactPoint=\"start\"><laneLink from=\"{}\" to=\"{}\"/></connection>",
          id, from.name, id, along, along);
    }
  text += fmt::format("<junction id=\"j\" name=\"\">{}</junction></OpenDRIVE>", connections);
  auto network = road::read_opendrive(text, "crossing.xodr");
  REQUIRE_MESSAGE(network.has_value(), (network ? std::string() : network.error().what));
  return *network;
}

}  // namespace septet::traffic
