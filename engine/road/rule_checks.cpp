#include "engine/road/rule_checks.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <pugixml.hpp>

namespace septet::road {
namespace {

std::uint32_t last_section(const Road& road) { return static_cast<std::uint32_t>(road.sections.size() - 1); }

LaneEnd at_contact(const RoadNetwork& network, RoadIndex index, ContactPoint contact, int lane) {
  const bool at_end = contact == ContactPoint::end;
  return {index, at_end ? last_section(network.roads[index]) : 0, lane, at_end};
}

bool exists(const CheckedFile& file, const LaneEnd& end) {
  return end.lane != 0 && section_of(file, end).has_lane(end.lane);
}

/// The elements of a road's sections; those beyond its end have none in the network.
std::vector<pugi::xml_node> section_nodes_of(const pugi::xml_node& road_node, const Road& road) {
  std::vector<pugi::xml_node> nodes;
  for (const auto node : road_node.child("lanes").children("laneSection"))
    if (nodes.size() < road.sections.size()) nodes.push_back(node);
  return nodes;
}

}  // namespace

void check_rules(XmlFindings& findings, const pugi::xml_node& root, const RoadNetwork& network) {
  std::vector<pugi::xml_node> roads;
  std::vector<std::vector<pugi::xml_node>> sections;
  for (const auto node : root.children("road")) {
    sections.push_back(section_nodes_of(node, network.roads[roads.size()]));
    roads.push_back(node);
  }
  const CheckedFile file{findings, root, roads, sections, network};
  check_required_attributes(file);
  check_curves(file);
  check_road_links(file);
  check_connections(file);
  check_linked_lanes(file);
  check_lane_sections(file);
  check_redundancy(file);
  check_steps(file);
}

const LaneSection& section_of(const CheckedFile& file, const LaneEnd& end) {
  return file.network.roads[end.road].sections[end.section];
}

const Lane& lane_of(const CheckedFile& file, const LaneEnd& end) { return section_of(file, end).lane(end.lane); }

double station_of(const CheckedFile& file, const LaneEnd& end) {
  const LaneSection& section = section_of(file, end);
  // Just inside, where the records before the section's end still hold.
  return end.at_end ? std::max(section.s_m, section.s_end_m - 1e-9) : section.s_m;
}

std::string name_of(const CheckedFile& file, const LaneEnd& end) {
  const LaneSection& section = section_of(file, end);
  return fmt::format("lane {} of road {} at s={:.3f}", end.lane, file.network.roads[end.road].id,
                     end.at_end ? section.s_end_m : section.s_m);
}

pugi::xml_node node_of(const CheckedFile& file, const LaneEnd& end) {
  const auto section = file.section_nodes[end.road][end.section];
  for (const auto node : section.child(end.lane > 0 ? "left" : "right").children("lane"))
    if (node.attribute("id").as_int() == end.lane) return node;
  return section;
}

std::optional<ContactPoint> incoming_contact(const RoadNetwork& network, JunctionIndex junction,
                                             const JunctionConnection& connection) {
  const Road &connecting = network.roads[connection.connecting], &incoming = network.roads[connection.incoming];
  const RoadLink& back = connection.contact == ContactPoint::start ? connecting.predecessor : connecting.successor;
  if (back.road == connection.incoming) return back.contact;
  const bool by_end = incoming.successor.junction == junction, by_start = incoming.predecessor.junction == junction;
  if (by_end == by_start) return std::nullopt;
  return by_end ? ContactPoint::end : ContactPoint::start;
}

void visit_lane_links(const CheckedFile& file,
                      const std::function<void(const LaneEnd& from, const LaneEnd& to, bool by_junction)>& visit) {
  const RoadNetwork& network = file.network;
  const auto visit_side = [&](const LaneEnd& from) {
    const Road& road = network.roads[from.road];
    const Lane& lane = lane_of(file, from);
    const bool at_road_end = from.section == (from.at_end ? last_section(road) : 0);
    const RoadLink& link = from.at_end ? road.successor : road.predecessor;
    if (at_road_end && link.road == no_index) return;
    for (const int id : from.at_end ? lane.successors : lane.predecessors) {
      const std::uint32_t next = from.at_end ? from.section + 1 : from.section - 1;
      const LaneEnd to =
          at_road_end ? at_contact(network, link.road, link.contact, id) : LaneEnd{from.road, next, id, !from.at_end};
      if (exists(file, to)) visit(from, to, false);
    }
  };
  for (RoadIndex index = 0; index < network.roads.size(); ++index)
    for (std::uint32_t i = 0; i < network.roads[index].sections.size(); ++i)
      for (const Lane& lane : network.roads[index].sections[i].lanes) {
        if (lane.id == 0) continue;
        visit_side({index, i, lane.id, false});
        visit_side({index, i, lane.id, true});
      }
  for (JunctionIndex index = 0; index < network.junctions.size(); ++index)
    for (const JunctionConnection& connection : network.junctions[index].connections) {
      const auto contact = incoming_contact(network, index, connection);
      if (!contact) continue;
      for (const LaneLink& link : connection.lane_links) {
        const LaneEnd from = at_contact(network, connection.incoming, *contact, link.from),
                      to = at_contact(network, connection.connecting, connection.contact, link.to);
        if (exists(file, from) && exists(file, to)) visit(from, to, true);
      }
    }
}

}  // namespace septet::road
