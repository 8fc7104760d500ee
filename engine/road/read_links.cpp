#include <map>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "engine/road/lane_links.hpp"
#include "engine/road/road_elements.hpp"

namespace septet::road {
namespace {

using Indices = std::map<std::string, std::uint32_t, std::less<>>;

std::uint32_t index_of(const Indices& indices, std::string_view id) {
  const auto found = indices.find(id);
  return found == indices.end() ? no_index : found->second;
}

ContactPoint read_contact(XmlFindings& findings, const pugi::xml_node& node) {
  const std::string_view text = node.attribute("contactPoint").value();
  if (text != "start" && text != "end") {
    findings.error(node, fmt::format("contactPoint=\"{}\" is neither start nor end", text.substr(0, 40)),
                   "write start or end");
  }
  return text == "end" ? ContactPoint::end : ContactPoint::start;
}

RoadLink read_road_link(XmlFindings& findings, const pugi::xml_node& node, const Indices& roads,
                        const Indices& junctions) {
  RoadLink link;
  if (!node) return link;
  const std::string_view type = node.attribute("elementType").value();
  const std::string id = findings.text(node, "elementId");
  if (type == "junction") {
    link.junction = index_of(junctions, id);
  } else if (type == "road") {
    link.road = index_of(roads, id);
    link.contact = read_contact(findings, node);
  } else {
    findings.error(node, fmt::format("elementType=\"{}\" is neither road nor junction", type.substr(0, 40)),
                   "write road or junction");
    return link;
  }
  // Maps cut out of larger ones are full of these.
  if (link.road == no_index && link.junction == no_index && !id.empty()) {
    findings.warning(node, fmt::format("{} {} does not exist; there is no link", type, id),
                     "link to one of the file, or remove the link");
  }
  return link;
}

/// Appends a connection to the junction, unless it leads from or to a road missing in the file.
void read_connection(XmlFindings& findings, const pugi::xml_node& node, const Indices& roads, Junction& junction) {
  JunctionConnection connection;
  connection.id = node.attribute("id").value();
  connection.incoming = index_of(roads, node.attribute("incomingRoad").value());
  const bool direct = node.attribute("linkedRoad");
  connection.connecting = index_of(roads, node.attribute(direct ? "linkedRoad" : "connectingRoad").value());
  if (connection.incoming == no_index || connection.connecting == no_index) {
    findings.warning(node, fmt::format("connection {} names a road that does not exist; it is left out", connection.id),
                     "check incomingRoad and connectingRoad (linkedRoad in a direct junction)");
    return;
  }
  connection.contact = read_contact(findings, node);
  for (const auto link : node.children("laneLink")) {
    const auto from = findings.integer(link, "from"), to = findings.integer(link, "to");
    if (from && to) connection.lane_links.push_back({*from, *to});
  }
  junction.connections.push_back(std::move(connection));
}

/// Appends a priority to the junction, unless it names a road missing in the file.
void read_priority(XmlFindings& findings, const pugi::xml_node& node, const Indices& roads, Junction& junction) {
  const JunctionPriority priority{index_of(roads, node.attribute("high").value()),
                                  index_of(roads, node.attribute("low").value())};
  if (priority.high == no_index || priority.low == no_index || priority.high == priority.low) {
    findings.warning(node,
                     fmt::format("a priority of junction {} does not name two roads; it is left out", junction.id),
                     "check high and low");
    return;
  }
  junction.priorities.push_back(priority);
}

Junction read_junction(XmlFindings& findings, const pugi::xml_node& node, const Indices& roads) {
  Junction junction;
  junction.id = node.attribute("id").value();
  junction.name = node.attribute("name").value();
  const std::string_view type = node.attribute("type").value();
  if (type == "direct") junction.kind = Junction::Kind::direct;
  if (type == "virtual") junction.kind = Junction::Kind::virtual_junction;
  if (type == "crossing") junction.kind = Junction::Kind::crossing;
  if (junction.kind == Junction::Kind::virtual_junction || junction.kind == Junction::Kind::crossing) {
    findings.warning(node, fmt::format("junctions of type {} are not followed", type),
                     "use a common or a direct junction");
    return junction;
  }
  for (const auto connection : node.children("connection")) {
    read_connection(findings, connection, roads, junction);
  }
  for (const auto priority : node.children("priority")) read_priority(findings, priority, roads, junction);
  return junction;
}

/// Reports lanes with a link to a lane that does not exist.
void check_ends(XmlFindings& findings, const pugi::xml_node& road_node, const RoadNetwork& network, RoadIndex index) {
  const Road& road = network.roads[index];
  for (std::uint32_t i = 0; i < road.sections.size(); ++i) {
    for (const Lane& lane : road.sections[i].lanes) {
      for (const bool along : {false, true}) {
        const auto& linked = along ? lane.successors : lane.predecessors;
        const bool at_road_end = along ? i + 1 == road.sections.size() : i == 0;
        const RoadLink& link = along ? road.successor : road.predecessor;
        if (lane.id == 0 || linked.empty() || (at_road_end && link.road == no_index)) continue;
        if (continuations(network, index, i, lane.id, along).size() >= linked.size()) continue;
        findings.warning(road_node,
                         fmt::format("lane {} of the section at s={} has a {} that does not exist", lane.id,
                                     road.sections[i].s_m, along ? "successor" : "predecessor"),
                         "link to a lane of the adjoining section, or remove the link");
      }
    }
  }
}

}  // namespace

void link_network(XmlFindings& findings, const pugi::xml_node& root, RoadNetwork& network) {
  Indices roads, junctions;
  for (RoadIndex i = 0; i < network.roads.size(); ++i) roads.emplace(network.roads[i].id, i);
  std::vector<pugi::xml_node> junction_nodes;
  for (const auto node : root.children("junction")) {
    const std::string id = findings.text(node, "id");
    if (!junctions.emplace(id, static_cast<JunctionIndex>(junction_nodes.size())).second) {
      findings.error(node, fmt::format("junction id {} is used twice", id), "give each junction its own id");
    }
    junction_nodes.push_back(node);
  }
  RoadIndex index = 0;
  for (const auto node : root.children("road")) {
    Road& road = network.roads[index++];
    const std::string_view junction = node.attribute("junction").value();
    if (!junction.empty() && junction != "-1") {
      road.junction = index_of(junctions, junction);
      if (road.junction == no_index) {
        findings.warning(node,
                         fmt::format("junction {} does not exist; the road belongs to none", junction.substr(0, 40)),
                         "write -1 or an id of a junction");
      }
    }
    road.predecessor = read_road_link(findings, node.child("link").child("predecessor"), roads, junctions);
    road.successor = read_road_link(findings, node.child("link").child("successor"), roads, junctions);
  }
  for (const auto node : junction_nodes) network.junctions.push_back(read_junction(findings, node, roads));
}

void check_lane_links(XmlFindings& findings, const pugi::xml_node& root, const RoadNetwork& network) {
  RoadIndex index = 0;
  for (const auto node : root.children("road")) check_ends(findings, node, network, index++);
}

}  // namespace septet::road
