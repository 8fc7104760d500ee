#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "engine/road/road_elements.hpp"
#include "engine/road/road_limits.hpp"

namespace septet::road {
namespace {

Orientation read_orientation(const pugi::xml_node& node) {
  const std::string_view text = node.attribute("orientation").value();
  if (text == "+") return Orientation::along;
  return text == "-" ? Orientation::against : Orientation::both;
}

constexpr double tolerated_past_end_m = 0.01;

/// Station of an object; beyond the road: a warning and the road's end.
double on_road(XmlFindings& findings, const pugi::xml_node& node, const Road& road, double s_m) {
  const double kept = std::clamp(s_m, 0.0, road.length_m);
  if (std::abs(s_m - kept) > tolerated_past_end_m) {
    findings.warning(
        node, fmt::format("s={} is beyond the road, which is {} m long; it is taken to its end", s_m, road.length_m),
        "keep s within the road");
  }
  return kept;
}

/// Length of an object that begins at `s_m`, cut off at the road's end.
double length_on_road(XmlFindings& findings, const pugi::xml_node& node, const Road& road, double s_m) {
  const double length = findings.amount_or(node, "length", 0.0);
  const double kept = std::min(length, road.length_m - s_m);
  if (length > kept + tolerated_past_end_m) {
    findings.warning(node, fmt::format("it reaches {:.4g} m beyond the road; it is cut off there", length - kept),
                     "keep s + length within the road");
  }
  return kept;
}

ObjectRepeat read_repeat(XmlFindings& findings, const pugi::xml_node& node, const Road& road,
                         const RoadObject& object) {
  const auto number_or = [&](const char* attribute, double fallback) {
    return findings.number_or(node, attribute, fallback, largest_object_m);
  };
  ObjectRepeat repeat;
  repeat.s_m = on_road(findings, node, road, findings.number_or(node, "s", object.s_m));
  repeat.length_m = length_on_road(findings, node, road, repeat.s_m);
  repeat.distance_m = findings.amount_or(node, "distance", 0.0);
  if (repeat.distance_m > 0.0 && repeat.distance_m < least_spacing_m) {
    findings.warning(node, fmt::format("distance={}; it is taken as one continuous object", repeat.distance_m),
                     fmt::format("give 0 or at least {} m", least_spacing_m));
    repeat.distance_m = 0.0;
  }
  repeat.t_start_m = number_or("tStart", object.t_m);
  repeat.t_end_m = number_or("tEnd", repeat.t_start_m);
  repeat.width_start_m = number_or("widthStart", object.width_m);
  repeat.width_end_m = number_or("widthEnd", repeat.width_start_m);
  repeat.height_start_m = number_or("heightStart", object.height_m);
  repeat.height_end_m = number_or("heightEnd", repeat.height_start_m);
  repeat.z_offset_start_m = number_or("zOffsetStart", object.z_offset_m);
  repeat.z_offset_end_m = number_or("zOffsetEnd", repeat.z_offset_start_m);
  return repeat;
}

Outline read_outline(XmlFindings& findings, const pugi::xml_node& node) {
  Outline outline;
  outline.closed = node.attribute("closed").as_bool(true);
  for (const auto corner : node.children()) {
    const std::string_view name = corner.name();
    const auto number = [&](const char* attribute, double most) { return findings.number(corner, attribute, most); };
    const auto number_or = [&](const char* attribute) {
      return findings.number_or(corner, attribute, 0.0, largest_object_m);
    };
    if (name == "cornerRoad") {
      outline.corners.push_back(
          {true, number("s", longest_road_m), number("t", largest_object_m), number_or("dz"), number_or("height")});
    } else if (name == "cornerLocal") {
      outline.corners.push_back(
          {false, number("u", largest_object_m), number("v", largest_object_m), number_or("z"), number_or("height")});
    }
  }
  return outline;
}

RoadObject read_object(XmlFindings& findings, const pugi::xml_node& node, const Road& road) {
  RoadObject object;
  object.id = node.attribute("id").value();
  object.name = node.attribute("name").value();
  object.type = node.attribute("type").value();
  object.subtype = node.attribute("subtype").value();
  object.s_m = on_road(findings, node, road, findings.number(node, "s"));
  object.t_m = findings.number(node, "t", largest_object_m);
  object.z_offset_m = findings.number_or(node, "zOffset", 0.0, largest_object_m);
  object.heading_rad = findings.number_or(node, "hdg", 0.0);
  object.pitch_rad = findings.number_or(node, "pitch", 0.0);
  object.roll_rad = findings.number_or(node, "roll", 0.0);
  object.length_m = findings.amount_or(node, "length", 0.0, longest_road_m);
  object.width_m = findings.amount_or(node, "width", 0.0, largest_object_m);
  object.height_m = findings.amount_or(node, "height", 0.0, largest_object_m);
  object.radius_m = findings.amount_or(node, "radius", 0.0, largest_object_m);
  object.orientation = read_orientation(node);
  for (const auto repeat : node.children("repeat"))
    object.repeats.push_back(read_repeat(findings, repeat, road, object));
  // Up to 1.4 the one outline is a child of the object; since then all are in a list.
  for (const auto& holder : {node, node.child("outlines")})
    for (const auto outline : holder.children("outline")) object.outlines.push_back(read_outline(findings, outline));
  if (const auto material = node.child("material")) object.material = read_material(findings, material);
  return object;
}

/// An object's outline as a polygon of (s, t); the road's bend within it is left out. Without an
/// outline: its rectangle, or its circle as 16 corners.
SurfacePatch patch_of(const RoadObject& object) {
  SurfacePatch patch{*object.material, {}, {}, {}};
  const double cosine = std::cos(object.heading_rad), sine = std::sin(object.heading_rad);
  const auto add_local = [&](double u_m, double v_m) {
    patch.corners_st_m.push_back({object.s_m + cosine * u_m - sine * v_m, object.t_m + sine * u_m + cosine * v_m});
  };
  if (!object.outlines.empty()) {
    for (const OutlineCorner& corner : object.outlines.front().corners) {
      if (corner.in_road_coordinates)
        patch.corners_st_m.push_back({corner.s_or_u_m, corner.t_or_v_m});
      else
        add_local(corner.s_or_u_m, corner.t_or_v_m);
    }
  } else if (object.radius_m > 0.0) {
    for (int i = 0; i < 16; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / 16.0;
      add_local(object.radius_m * std::cos(angle), object.radius_m * std::sin(angle));
    }
  } else {
    const double u = 0.5 * object.length_m, v = 0.5 * object.width_m;
    for (const auto& [x, y] : {std::pair{-u, -v}, {u, -v}, {u, v}, {-u, v}}) add_local(x, y);
  }
  if (patch.corners_st_m.empty()) return patch;
  patch.low_st_m = patch.high_st_m = patch.corners_st_m.front();
  for (const Vec2& corner : patch.corners_st_m) {
    patch.low_st_m = glm::min(patch.low_st_m, corner);
    patch.high_st_m = glm::max(patch.high_st_m, corner);
  }
  return patch;
}

void read_structures(XmlFindings& findings, const pugi::xml_node& objects, const char* element,
                     RoadStructure::Kind kind, Road& road) {
  for (const auto node : objects.children(element)) {
    RoadStructure structure;
    structure.kind = kind;
    structure.id = node.attribute("id").value();
    structure.name = node.attribute("name").value();
    structure.type = node.attribute("type").value();
    structure.s_m = on_road(findings, node, road, findings.number(node, "s"));
    structure.length_m = length_on_road(findings, node, road, structure.s_m);
    if (structure.length_m > 0.0) road.structures.push_back(std::move(structure));
  }
}

}  // namespace

void read_objects(XmlFindings& findings, const pugi::xml_node& road_node, Road& road) {
  const auto objects = road_node.child("objects");
  for (const auto node : objects.children("object")) road.objects.push_back(read_object(findings, node, road));
  for (const RoadObject& object : road.objects)
    if (object.material) road.patches.push_back(patch_of(object));
  read_structures(findings, objects, "bridge", RoadStructure::Kind::bridge, road);
  read_structures(findings, objects, "tunnel", RoadStructure::Kind::tunnel, road);
}

void read_signals(XmlFindings& findings, const pugi::xml_node& road_node, Road& road) {
  for (const auto node : road_node.child("signals").children("signal")) {
    Signal signal;
    signal.id = node.attribute("id").value();
    signal.name = node.attribute("name").value();
    signal.country = node.attribute("country").value();
    signal.type = node.attribute("type").value();
    signal.subtype = node.attribute("subtype").value();
    signal.unit = node.attribute("unit").value();
    signal.text = node.attribute("text").value();
    signal.s_m = on_road(findings, node, road, findings.number(node, "s"));
    signal.t_m = findings.number(node, "t", largest_object_m);
    signal.z_offset_m = findings.number_or(node, "zOffset", 0.0, largest_object_m);
    signal.value = findings.number_or(node, "value", 0.0);
    signal.height_m = findings.amount_or(node, "height", 0.0, tallest_m);
    signal.width_m = findings.amount_or(node, "width", 0.0, tallest_m);
    signal.heading_offset_rad = findings.number_or(node, "hOffset", 0.0);
    signal.pitch_rad = findings.number_or(node, "pitch", 0.0);
    signal.roll_rad = findings.number_or(node, "roll", 0.0);
    signal.orientation = read_orientation(node);
    signal.dynamic = std::string_view(node.attribute("dynamic").value()) == "yes";
    if (const auto validity = node.child("validity")) {
      signal.from_lane = findings.integer(validity, "fromLane").value_or(0);
      signal.to_lane = findings.integer(validity, "toLane").value_or(0);
    }
    road.signals.push_back(std::move(signal));
  }
}

}  // namespace septet::road
