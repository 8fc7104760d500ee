#pragma once
/// A roundabout of one lane and four arms, written as OpenDRIVE: traffic keeps right, so it drives the ring anticlockwise.
/// Arms are 150 m long, named by where they lie; ways in and out are one arc each that touches the arm's axis and the
/// ring. Arm K's roads are K, K-in (arm to ring), K-out (ring to arm), K-past (along the ring before it) and K-next
/// (along the ring to the next arm).

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "engine/road/opendrive_reader.hpp"
#include "engine/road/road_network.hpp"

namespace septet::traffic {

inline road::RoadNetwork roundabout() {
  constexpr double pi = std::numbers::pi, ring_m = 16.0, ring_lane_m = 5.0, arm_lane_m = 3.5, arm_m = 150.0;
  constexpr double beside = 32.0 * pi / 180.0;  // From an arm to where its ways touch the ring.
  const double way_m = ring_m * std::sin(beside) / (1.0 - std::sin(beside));
  const double half_m = (ring_m + way_m) * std::cos(beside);
  const double way_length_m = (0.5 * pi - beside) * way_m;
  struct Shape {
    double x, y, heading, length_m, curvature_per_m;
  };
  struct Link {
    std::string type, id, contact;
  };
  const std::array<std::string, 4> names{"south", "east", "north", "west"};
  std::string text = "<OpenDRIVE><header revMajor=\"1\" revMinor=\"8\" name=\"roundabout\"/>", junctions;
  const auto lane = [](int id, double from_m, double to_m, double length_m, const std::string& link) {
    return fmt::format(
        "<lane id=\"{}\" type=\"driving\" level=\"false\">{}<width sOffset=\"0\" a=\"{}\" b=\"{}\" c=\"0\" "
        "d=\"0\"/></lane>",
        id, link, from_m, (to_m - from_m) / length_m);
  };
  const auto add_road = [&](const std::string& id, const std::string& junction, const Link& before, const Link& after,
                            const Shape& shape, const std::string& left, const std::string& right) {
    const auto link = [](const char* side, const Link& to) {
      if (to.id.empty()) return std::string();
      const std::string contact = to.contact.empty() ? "" : fmt::format(" contactPoint=\"{}\"", to.contact);
      return fmt::format("<{} elementType=\"{}\" elementId=\"{}\"{}/>", side, to.type, to.id, contact);
    };
    text += fmt::format(
        "<road id=\"{}\" name=\"\" length=\"{}\" junction=\"{}\" rule=\"RHT\"><link>{}{}</link><type s=\"0\" "
        "type=\"town\"><speed max=\"50\" unit=\"km/h\"/></type><planView><geometry s=\"0\" x=\"{}\" y=\"{}\" "
        "hdg=\"{}\" length=\"{}\">{}</geometry></planView><lanes><laneSection s=\"0\">{}<center><lane id=\"0\" "
        "type=\"none\" level=\"false\"/></center><right>{}</right></laneSection></lanes></road>",
        id, shape.length_m, junction, link("predecessor", before), link("successor", after), shape.x, shape.y,
        shape.heading, shape.length_m,
        shape.curvature_per_m == 0.0 ? std::string("<line/>")
                                     : fmt::format("<arc curvature=\"{}\"/>", shape.curvature_per_m),
        left, right);
  };
  const auto on_ring = [&](double angle, double length_m) {
    return Shape{ring_m * std::cos(angle), ring_m * std::sin(angle), angle + 0.5 * pi, length_m, 1.0 / ring_m};
  };
  const auto linked = [](int before, int after) {
    return fmt::format("<link><predecessor id=\"{}\"/><successor id=\"{}\"/></link>", before, after);
  };
  for (std::size_t k = 0; k < names.size(); ++k) {
    const std::string &arm = names[k], &last = names[(k + 3) % 4], &next = names[(k + 1) % 4];
    const double angle = (static_cast<double>(k) - 1.0) * 0.5 * pi;
    const double x = std::cos(angle), y = std::sin(angle);
    const std::string junction = "at-" + arm;
    // Its reference line leads to the middle.
    add_road(
        arm, "-1", {}, {"junction", junction, ""}, {(half_m + arm_m) * x, (half_m + arm_m) * y, angle + pi, arm_m, 0.0},
        "<left>" + lane(1, arm_lane_m, arm_lane_m, arm_m, "") + "</left>", lane(-1, arm_lane_m, arm_lane_m, arm_m, ""));
    add_road(arm + "-in", junction, {"road", arm, "end"}, {"road", arm + "-next", "start"},
             {half_m * x, half_m * y, angle + pi, way_length_m, -1.0 / way_m}, "",
             lane(-1, arm_lane_m, ring_lane_m, way_length_m, linked(-1, -1)));
    const Shape leaves = on_ring(angle - beside, way_length_m);
    add_road(arm + "-out", junction, {"road", last + "-next", "end"}, {"road", arm, "end"},
             {leaves.x, leaves.y, leaves.heading, way_length_m, -1.0 / way_m}, "",
             lane(-1, ring_lane_m, arm_lane_m, way_length_m, linked(-1, 1)));
    const double past_m = 2.0 * beside * ring_m, next_m = (0.5 * pi - 2.0 * beside) * ring_m;
    add_road(arm + "-past", junction, {"road", last + "-next", "end"}, {"road", arm + "-next", "start"},
             on_ring(angle - beside, past_m), "", lane(-1, ring_lane_m, ring_lane_m, past_m, linked(-1, -1)));
    add_road(arm + "-next", "-1", {"junction", junction, ""}, {"junction", "at-" + next, ""},
             on_ring(angle + beside, next_m), "", lane(-1, ring_lane_m, ring_lane_m, next_m, ""));
    const auto connection = [&](const std::string& from, const std::string& by) {
      return fmt::format(
          "<connection id=\"{0}\" incomingRoad=\"{1}\" connectingRoad=\"{0}\" contactPoint=\"start\"><laneLink "
          "from=\"-1\" to=\"-1\"/></connection>",
          by, from);
    };
    junctions += fmt::format("<junction id=\"{}\" name=\"\">{}{}{}</junction>", junction, connection(arm, arm + "-in"),
                             connection(last + "-next", arm + "-out"), connection(last + "-next", arm + "-past"));
  }
  text += junctions + "</OpenDRIVE>";
  auto network = road::read_opendrive(text, "roundabout.xodr");
  REQUIRE_MESSAGE(network.has_value(), (network ? std::string() : network.error().what));
  return *network;
}

}  // namespace septet::traffic
