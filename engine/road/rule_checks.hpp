#pragma once
/// The standard's checker rules, applied to a file that could be read (CHECKS.md lists them). Used by the reader only.
///
/// A rule applies from the revision that introduced it: uses that a file's own revision allows are silent. All findings
/// here are warnings; none keeps a road from being driven on.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/road/road_elements.hpp"

namespace septet::road {

/// Input of all checks: the elements of roads and lane sections in the order of the network's.
struct CheckedFile {
  XmlFindings& findings;
  const pugi::xml_node& root;
  const std::vector<pugi::xml_node>& road_nodes;
  const std::vector<std::vector<pugi::xml_node>>& section_nodes;
  const RoadNetwork& network;

  /// True where the file declares OpenDRIVE 1.`minor` or later.
  bool is_at_least(int minor) const { return network.header.revision_minor >= minor; }
};

/// One end of a lane within one section.
struct LaneEnd {
  RoadIndex road = 0;
  std::uint32_t section = 0;
  int lane = 0;
  bool at_end = false;  ///< True at the section's end; false at its start.

  auto operator<=>(const LaneEnd&) const = default;
};

const LaneSection& section_of(const CheckedFile& file, const LaneEnd& end);
const Lane& lane_of(const CheckedFile& file, const LaneEnd& end);
/// The station of the end, within its section.
double station_of(const CheckedFile& file, const LaneEnd& end);
/// "lane -1 of road 5 at s=20".
std::string name_of(const CheckedFile& file, const LaneEnd& end);
/// The lane's element, or that of its section.
pugi::xml_node node_of(const CheckedFile& file, const LaneEnd& end);

/// The end of the incoming road at a connection; empty where its links do not tell.
std::optional<ContactPoint> incoming_contact(const RoadNetwork& network, JunctionIndex junction,
                                             const JunctionConnection& connection);

/// Calls visit(from, to, by_junction) for every lane that is linked to an existing lane: across sections, roads and
/// connections of junctions. A pair that is linked both ways comes twice, a connection's once.
void visit_lane_links(const CheckedFile& file,
                      const std::function<void(const LaneEnd& from, const LaneEnd& to, bool by_junction)>& visit);

void check_required_attributes(const CheckedFile& file);
void check_curves(const CheckedFile& file);
void check_road_links(const CheckedFile& file);
void check_connections(const CheckedFile& file);
void check_linked_lanes(const CheckedFile& file);   ///< Both ways, widths, levels, gaps.
void check_lane_sections(const CheckedFile& file);  ///< Levels, access, borders.
void check_redundancy(const CheckedFile& file);
void check_steps(const CheckedFile& file);  ///< Steps of the surface and of the lanes within each road.

}  // namespace septet::road
