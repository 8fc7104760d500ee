#include <cmath>
#include <numbers>
#include <utility>

#include <pugixml.hpp>

#include "engine/road/opendrive_parts.hpp"

namespace septet::road {
namespace {

Orientation read_orientation(const pugi::xml_node& node) {
  const std::string_view text = node.attribute("orientation").value();
  if (text == "+") return Orientation::along;
  return text == "-" ? Orientation::against : Orientation::both;
}

ObjectRepeat read_repeat(XmlFindings& findings, const pugi::xml_node& node,
                         const RoadObject& object) {
  const auto number_or = [&](const char* attribute, double fallback) {
    return findings.number_or(node, attribute, fallback);
  };
  ObjectRepeat repeat;
  repeat.s_m = number_or("s", object.s_m);
  repeat.length_m = number_or("length", 0.0);
  repeat.distance_m = number_or("distance", 0.0);
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
    if (name == "cornerRoad") {
      outline.corners.push_back({true, findings.number(corner, "s"), findings.number(corner, "t"),
                                 findings.number_or(corner, "dz", 0.0),
                                 findings.number_or(corner, "height", 0.0)});
    } else if (name == "cornerLocal") {
      outline.corners.push_back({false, findings.number(corner, "u"), findings.number(corner, "v"),
                                 findings.number_or(corner, "z", 0.0),
                                 findings.number_or(corner, "height", 0.0)});
    }
  }
  return outline;
}

RoadObject read_object(XmlFindings& findings, const pugi::xml_node& node) {
  RoadObject object;
  object.id = node.attribute("id").value();
  object.name = node.attribute("name").value();
  object.type = node.attribute("type").value();
  object.subtype = node.attribute("subtype").value();
  object.s_m = findings.number(node, "s");
  object.t_m = findings.number(node, "t");
  object.z_offset_m = findings.number_or(node, "zOffset", 0.0);
  object.heading_rad = findings.number_or(node, "hdg", 0.0);
  object.pitch_rad = findings.number_or(node, "pitch", 0.0);
  object.roll_rad = findings.number_or(node, "roll", 0.0);
  object.length_m = findings.number_or(node, "length", 0.0);
  object.width_m = findings.number_or(node, "width", 0.0);
  object.height_m = findings.number_or(node, "height", 0.0);
  object.radius_m = findings.number_or(node, "radius", 0.0);
  object.orientation = read_orientation(node);
  for (const auto repeat : node.children("repeat"))
    object.repeats.push_back(read_repeat(findings, repeat, object));
  // Up to 1.4 the one outline is a child of the object; since then all are in a list.
  for (const auto& holder : {node, node.child("outlines")})
    for (const auto outline : holder.children("outline"))
      object.outlines.push_back(read_outline(findings, outline));
  if (const auto material = node.child("material"))
    object.material = read_material(findings, material);
  return object;
}

/// An object's outline as a polygon of (s, t); the road's bend within it is left out. Without an
/// outline: its rectangle, or its circle as 16 corners.
SurfacePatch patch_of(const RoadObject& object) {
  SurfacePatch patch{*object.material, {}, {}, {}};
  const double cosine = std::cos(object.heading_rad), sine = std::sin(object.heading_rad);
  const auto add_local = [&](double u_m, double v_m) {
    patch.corners_st_m.push_back(
        {object.s_m + cosine * u_m - sine * v_m, object.t_m + sine * u_m + cosine * v_m});
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
    structure.s_m = findings.number(node, "s");
    structure.length_m = findings.number(node, "length");
    if (structure.s_m < 0.0 || structure.length_m < 0.0 ||
        structure.s_m + structure.length_m > road.length_m + 0.01) {
      findings.warning(node, "it reaches beyond the road", "keep s and s + length within the road");
    }
    road.structures.push_back(std::move(structure));
  }
}

}  // namespace

void read_objects(XmlFindings& findings, const pugi::xml_node& road_node, Road& road) {
  const auto objects = road_node.child("objects");
  for (const auto node : objects.children("object"))
    road.objects.push_back(read_object(findings, node));
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
    signal.s_m = findings.number(node, "s");
    signal.t_m = findings.number(node, "t");
    signal.z_offset_m = findings.number_or(node, "zOffset", 0.0);
    signal.value = findings.number_or(node, "value", 0.0);
    signal.height_m = findings.number_or(node, "height", 0.0);
    signal.width_m = findings.number_or(node, "width", 0.0);
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
