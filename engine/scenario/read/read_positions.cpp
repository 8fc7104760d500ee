#include "engine/scenario/read/scenario_reading.hpp"

namespace septet::scenario {
namespace {

WorldPosition read_world(const Element& element) {
  WorldPosition position;
  position.position_m = {element.number("x"), element.number("y"), element.number_or("z", 0.0)};
  position.height_m = element.optional_number("z");
  position.heading_given = element.has("h");
  position.heading_rad = element.number_or("h", 0.0);
  position.pitch_rad = element.number_or("p", 0.0);
  position.roll_rad = element.number_or("r", 0.0);
  return position;
}

LaneCoordinates read_lane(const Reading& reading, const Element& element) {
  LaneCoordinates position;
  position.road = element.text("roadId");
  position.lane = element.integer("laneId", -most_lanes, most_lanes);
  position.s_m = element.number("s", 0.0);
  position.offset_m = element.number_or("offset", 0.0);
  position.orientation = read_orientation(reading, element);
  return position;
}

RelativeLanePosition read_relative_lane(Reading& reading, const Element& element) {
  RelativeLanePosition position;
  position.entity = read_entity_reference(reading, element);
  position.lanes_to_the_left = element.integer("dLane", -most_lanes, most_lanes);
  position.along_lane = element.has("dsLane");
  position.ds_m = position.along_lane ? element.number("dsLane") : element.number("ds");
  position.offset_m = element.number_or("offset", 0.0);
  position.orientation = read_orientation(reading, element);
  return position;
}

template <class Relative>
Relative read_offset(Reading& reading, const Element& element) {
  Relative position;
  position.entity = read_entity_reference(reading, element);
  position.delta_m = {element.number("dx"), element.number("dy"), element.number_or("dz", 0.0)};
  position.orientation = read_orientation(reading, element);
  return position;
}

Position read_kind(Reading& reading, const Element& position) {
  if (const Element found = position.child("LanePosition")) return read_lane(reading, found);
  if (const Element found = position.child("RelativeLanePosition")) return read_relative_lane(reading, found);
  if (const Element found = position.child("WorldPosition")) return read_world(found);
  if (const Element found = position.child("RelativeWorldPosition"))
    return read_offset<RelativeWorldPosition>(reading, found);
  if (const Element found = position.child("RelativeObjectPosition"))
    return read_offset<RelativeObjectPosition>(reading, found);
  if (const Element found = position.child("RoadPosition")) {
    RoadCoordinates road{found.text("roadId"), found.number("s", 0.0), found.number("t"), {}};
    road.orientation = read_orientation(reading, found);
    return road;
  }
  if (const Element found = position.child("RelativeRoadPosition")) {
    RelativeRoadPosition road{read_entity_reference(reading, found), found.number("ds"), found.number("dt"), {}};
    road.orientation = read_orientation(reading, found);
    return road;
  }
  if (const Element found = position.child("RoutePosition")) return read_route_position(reading, found);
  if (position.all_children().empty()) position.error("it is empty", "add a position such as <LanePosition>");
  return {};
}

}  // namespace

Orientation read_orientation(const Reading& reading, const Element& position) {
  const Element orientation = position.child("Orientation");
  if (!orientation) return {};
  Orientation result;
  result.given = true;
  result.relative = orientation.word<bool>("type", {{"relative", true}, {"absolute", false}},
                                           reading.scenario.header.revision_minor >= 3);
  result.heading_rad = orientation.number_or("h", 0.0);
  result.pitch_rad = orientation.number_or("p", 0.0);
  result.roll_rad = orientation.number_or("r", 0.0);
  return result;
}

Position read_position(Reading& reading, const Element& parent) {
  return read_position_in(reading, parent.required("Position"));
}

Position read_position_in(Reading& reading, const Element& position) {
  if (!position) return {};
  Position found = read_kind(reading, position);
  if (reading.checking) reading.positions.emplace_back(position, found);
  return found;
}

}  // namespace septet::scenario
