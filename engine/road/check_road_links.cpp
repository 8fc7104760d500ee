#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <tuple>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "engine/road/lane_links.hpp"
#include "engine/road/rule_checks.hpp"

namespace septet::road {
namespace {

/// The elements of a junction's connections that the network has adopted, in its order.
std::vector<pugi::xml_node> connection_nodes(const std::set<std::string_view>& road_ids,
                                             const pugi::xml_node& junction) {
  std::vector<pugi::xml_node> nodes;
  for (const auto node : junction.children("connection")) {
    const bool direct = node.attribute("linkedRoad");
    if (road_ids.contains(node.attribute("incomingRoad").value()) &&
        road_ids.contains(node.attribute(direct ? "linkedRoad" : "connectingRoad").value()))
      nodes.push_back(node);
  }
  return nodes;
}

/// True where traffic of the lane runs into the road's end (of the incoming road); false where it runs out of it.
bool runs_into(const Road& road, const LaneSection& section, int lane, ContactPoint contact) {
  return runs_along_s(road, section, lane) == (contact == ContactPoint::end);
}

/// A direct junction is passed both ways, a common one by its connecting roads' own links.
void check_lane_link(const CheckedFile& file, const pugi::xml_node& node, const JunctionConnection& connection,
                     ContactPoint contact, const LaneLink& link, bool one_way) {
  const Road &incoming = file.network.roads[connection.incoming],
             &connecting = file.network.roads[connection.connecting];
  const LaneSection& from = contact == ContactPoint::end ? incoming.sections.back() : incoming.sections.front();
  const LaneSection& to =
      connection.contact == ContactPoint::end ? connecting.sections.back() : connecting.sections.front();
  for (const auto& [section, lane, road] :
       {std::tuple{&from, link.from, &incoming}, std::tuple{&to, link.to, &connecting}}) {
    if (section->has_lane(lane)) continue;
    file.findings.warning(node,
                          fmt::format("its lane link {} to {} names a lane that road {} does not "
                                      "have there",
                                      link.from, link.to, road->id),
                          "link lanes of the sections that touch");
    return;
  }
  if (!file.is_at_least(8) || !one_way) return;
  const bool from_both = from.lane(link.from).direction == LaneDirection::both,
             to_both = to.lane(link.to).direction == LaneDirection::both;
  const bool enters = from_both || runs_into(incoming, from, link.from, contact),
             leaves = to_both || !runs_into(connecting, to, link.to, connection.contact);
  if (enters && leaves) return;
  file.findings.warning(node, fmt::format("its lane link {} to {} runs against the traffic", link.from, link.to),
                        "link only lanes that lead into the junction",
                        "asam.net:xodr:1.8.0:junctions.connection.one_link_to_incoming");
}

void check_contact(const CheckedFile& file, const pugi::xml_node& node, const JunctionConnection& connection) {
  const Road& connecting = file.network.roads[connection.connecting];
  const bool start = connection.contact == ContactPoint::start;
  const RoadLink& back = start ? connecting.predecessor : connecting.successor;
  if (!file.is_at_least(7) || back.road == no_index || back.road == connection.incoming) return;
  file.findings.warning(node,
                        fmt::format("contactPoint=\"{}\", but road {} is linked to road {} there",
                                    start ? "start" : "end", connecting.id, file.network.roads[back.road].id),
                        "name the end at which the connecting road touches the incoming one",
                        start ? "asam.net:xodr:1.7.0:junctions.connection.start_along_linkage"
                              : "asam.net:xodr:1.7.0:junctions.connection.end_opposite_linkage");
}

/// True where some connection takes on a lane of a road that runs into a junction by this end of it.
bool is_taken_on(const Junction& junction, RoadIndex road, int lane) {
  return std::ranges::any_of(junction.connections, [&](const JunctionConnection& connection) {
    const auto& links = connection.lane_links;
    return connection.incoming == road &&
           (links.empty() || std::ranges::find(links, lane, &LaneLink::from) != links.end());
  });
}

/// Who comes to a junction by this end of a road is to get on from there, by one of its lanes at least.
void check_way_out(const CheckedFile& file, RoadIndex index, bool at_end) {
  const Road& road = file.network.roads[index];
  const JunctionIndex to = at_end ? road.successor.junction : road.predecessor.junction;
  if (road.junction != no_index || to == no_index) return;
  const Junction& junction = file.network.junctions[to];
  if (junction.kind != Junction::Kind::common || junction.connections.empty()) return;
  const LaneSection& section = at_end ? road.sections.back() : road.sections.front();
  bool comes = false;
  for (int lane = -section.right_count; lane <= section.left_count; ++lane) {
    if (lane == 0 || !is_drivable(section.lane(lane).type) ||
        !runs_into(road, section, lane, at_end ? ContactPoint::end : ContactPoint::start))
      continue;
    if (is_taken_on(junction, index, lane)) return;
    comes = true;
  }
  if (comes)
    file.findings.warning(file.road_nodes[index].child("link").child(at_end ? "successor" : "predecessor"),
                          fmt::format("who comes to junction {} by road {} has no way out of it", junction.id, road.id),
                          "give the junction a connection with this incomingRoad");
}

}  // namespace

void check_road_links(const CheckedFile& file) {
  // Claimant of each end of a road; connecting roads may share one.
  std::map<std::pair<RoadIndex, ContactPoint>, RoadIndex> claimed;
  for (RoadIndex index = 0; index < file.network.roads.size(); ++index) {
    const Road& road = file.network.roads[index];
    for (const bool along : {false, true}) {
      const RoadLink& link = along ? road.successor : road.predecessor;
      if (link.road == no_index) continue;
      const auto node = file.road_nodes[index].child("link").child(along ? "successor" : "predecessor");
      if (link.road == index && (link.contact == ContactPoint::end) == along) {
        file.findings.warning(node, fmt::format("road {} is linked to this very end of itself", road.id),
                              "link to the end that it joins");
      }
      if (road.junction != no_index) continue;
      const auto [other, first] = claimed.try_emplace({link.road, link.contact}, index);
      if (first) continue;
      file.findings.warning(
          node,
          fmt::format("the {} of road {} is linked to road {} and road {}",
                      link.contact == ContactPoint::end ? "end" : "start", file.network.roads[link.road].id,
                      file.network.roads[other->second].id, road.id),
          "use a junction where a road goes on in more than one",
          "asam.net:xodr:1.4.0:road.linkage.is_junction_needed");
    }
  }
}

void check_connections(const CheckedFile& file) {
  std::set<std::string_view> road_ids;
  for (const Road& road : file.network.roads) road_ids.insert(road.id);
  std::set<RoadIndex> connected;
  JunctionIndex index = 0;
  for (const auto junction_node : file.root.children("junction")) {
    const Junction& junction = file.network.junctions[index];
    const bool is_followed = junction.kind == Junction::Kind::common || junction.kind == Junction::Kind::direct;
    if (is_followed && !junction_node.child("connection"))
      file.findings.warning(junction_node,
                            fmt::format("junction {} has no connections: nobody gets through", junction.id),
                            "give it connections, or link its roads to each other");
    const auto nodes = connection_nodes(road_ids, junction_node);
    for (std::size_t i = 0; i < junction.connections.size() && i < nodes.size(); ++i) {
      const JunctionConnection& connection = junction.connections[i];
      const bool common = junction.kind == Junction::Kind::common;
      if (const auto contact = incoming_contact(file.network, index, connection))
        for (const LaneLink& link : connection.lane_links)
          check_lane_link(file, nodes[i], connection, *contact, link, common);
      if (!common) continue;
      check_contact(file, nodes[i], connection);
      if (file.network.roads[connection.incoming].junction != no_index) {
        file.findings.warning(
            nodes[i],
            fmt::format("its incoming road {} is a connecting road", file.network.roads[connection.incoming].id),
            "name a road outside the junction",
            "asam.net:xodr:1.4.0:junctions.connection.connect_road_no_incoming_road");
      }
      // The rule exists in 1.7 alone.
      const bool first = connected.insert(connection.connecting).second;
      if (!first && file.network.header.revision_minor == 7) {
        file.findings.warning(
            nodes[i], fmt::format("road {} has a connection already", file.network.roads[connection.connecting].id),
            "give each connecting road one connection with all its lane links",
            "asam.net:xodr:1.7.0:junctions.connection.one_connection_element");
      }
    }
    ++index;
  }
  for (RoadIndex road = 0; road < file.network.roads.size(); ++road)
    for (const bool at_end : {false, true}) check_way_out(file, road, at_end);
}

}  // namespace septet::road
