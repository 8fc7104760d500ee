#pragma once
/// Readers of the elements of an OpenDRIVE road: each fills its element's part of the road. Used by the OpenDRIVE
/// reader only.

#include "engine/road/road_network.hpp"
#include "engine/road/xml_findings.hpp"

namespace septet::road {

/// The header's offset: x and y are added, then the plane is turned about (0, 0); z lifts every elevation record.
struct HeaderOffset {
  Vec2 shift_m{0.0, 0.0};
  double z_m = 0.0;
  double heading_rad = 0.0;
};

/// Records `<element s|sOffset a b c d>` below `parent`, in ascending order; `s_start_m` is added to each offset.
CubicProfile read_profile(XmlFindings& findings, const pugi::xml_node& parent, const char* element,
                          const char* station_attribute, double s_start_m);

void read_plan(XmlFindings& findings, const pugi::xml_node& road_node, const HeaderOffset& offset, Road& road);
void read_elevation(XmlFindings& findings, const pugi::xml_node& road_node, const HeaderOffset& offset, Road& road);
void read_lateral(XmlFindings& findings, const pugi::xml_node& road_node, Road& road);
void read_lanes(XmlFindings& findings, const pugi::xml_node& road_node, Road& road);
/// Checks that the lanes make a surface: they do not fold over, nor leave the world upwards.
void check_surface(XmlFindings& findings, const pugi::xml_node& road_node, const Road& road);
std::vector<RoadMark> read_marks(XmlFindings& findings, const pugi::xml_node& lane_node, const LaneSection& section);
/// A `<material>` of a lane or of an object that is a patch of the road.
SurfaceMaterial read_material(XmlFindings& findings, const pugi::xml_node& node);
/// Metres per second of a `<speed max unit>`; 0 for "no limit" and "undefined".
double read_speed(XmlFindings& findings, const pugi::xml_node& node);
void read_objects(XmlFindings& findings, const pugi::xml_node& road_node, Road& road);
void read_signals(XmlFindings& findings, const pugi::xml_node& road_node, Road& road);

/// Roads and junctions of the file refer to each other by id; this turns ids into indices, once all are read.
void link_network(XmlFindings& findings, const pugi::xml_node& root, RoadNetwork& network);
/// Checks that need all links: lanes linked to lanes that do not exist, marks' ends, flat roads.
void check_lane_links(XmlFindings& findings, const pugi::xml_node& root, const RoadNetwork& network);
/// Checks a file without errors against the standard's checker rules (rule_checks.hpp).
void check_rules(XmlFindings& findings, const pugi::xml_node& root, const RoadNetwork& network);

}  // namespace septet::road
