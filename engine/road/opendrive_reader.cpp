#include "engine/road/opendrive_reader.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "engine/road/opendrive_parts.hpp"
#include "engine/road/road_locate.hpp"

namespace septet::road {
namespace {

constexpr std::size_t largest_text = 512u << 20;
constexpr double longest_road_m = 1e7;
/// Knots of all curves together (plan_curve.hpp), so that a small text cannot ask for much memory.
constexpr std::size_t most_knots = 8'000'000;

HeaderOffset read_header(XmlFindings& findings, const pugi::xml_node& root, NetworkHeader& header) {
  const auto node = root.child("header");
  if (!node) {
    findings.warning(root, "there is no header", "add <header revMajor=\"1\" revMinor=\"8\"/>");
    return {};
  }
  header.revision_major = node.attribute("revMajor").as_int(1);
  header.revision_minor = node.attribute("revMinor").as_int(0);
  header.name = node.attribute("name").value();
  header.geo_reference = node.child("geoReference").text().get();
  if (header.revision_major != 1 || header.revision_minor < 4 || header.revision_minor > 8) {
    findings.warning(
        node,
        fmt::format("OpenDRIVE {}.{} is read as 1.8", header.revision_major, header.revision_minor),
        "use a revision from 1.4 to 1.8");
  }
  const auto offset = node.child("offset");
  if (!offset) return {};
  return {{findings.number_or(offset, "x", 0.0), findings.number_or(offset, "y", 0.0)},
          findings.number_or(offset, "z", 0.0),
          findings.number_or(offset, "hdg", 0.0)};
}

TrafficRule read_rule(XmlFindings& findings, const pugi::xml_node& node) {
  const std::string_view rule = node.attribute("rule").value();
  if (!rule.empty() && rule != "RHT" && rule != "LHT") {
    findings.error(node, fmt::format("rule=\"{}\" is neither RHT nor LHT", rule.substr(0, 40)),
                   "write RHT or LHT");
  }
  return rule == "LHT" ? TrafficRule::left_hand : TrafficRule::right_hand;
}

Road read_road(XmlFindings& findings, const pugi::xml_node& node, const HeaderOffset& offset) {
  Road road;
  road.id = findings.text(node, "id");
  road.name = node.attribute("name").value();
  road.rule = read_rule(findings, node);
  road.length_m = findings.number(node, "length");
  if (!(road.length_m > 0.0) || road.length_m > longest_road_m) {
    findings.error(node, fmt::format("road {} has the length {} m", road.id, road.length_m),
                   fmt::format("give a length above 0 and up to {} m", longest_road_m));
    road.length_m = 1.0;
  }
  for (const auto type : node.children("type")) {
    RoadTypeRecord record{findings.number_or(type, "s", 0.0), type.attribute("type").value(), 0.0};
    if (const auto speed = type.child("speed"))
      record.speed_limit_mps = read_speed(findings, speed);
    road.types.push_back(std::move(record));
  }
  std::stable_sort(road.types.begin(), road.types.end(),
                   [](const auto& a, const auto& b) { return a.s_m < b.s_m; });
  read_plan(findings, node, offset, road);
  read_elevation(findings, node, offset, road);
  read_lateral(findings, node, road);
  read_lanes(findings, node, road);
  read_objects(findings, node, road);
  read_signals(findings, node, road);
  return road;
}

void read_roads(XmlFindings& findings, const pugi::xml_node& root, const HeaderOffset& offset,
                RoadNetwork& network) {
  std::set<std::string> ids;
  std::size_t knots = 0;
  for (const auto node : root.children("road")) {
    network.roads.push_back(read_road(findings, node, offset));
    const Road& road = network.roads.back();
    if (!ids.insert(road.id).second) {
      findings.error(node, fmt::format("road id {} is used twice", road.id),
                     "give each road its own id");
    }
    knots += road.plan.clothoid_knots.size() + road.plan.cubic_knots.size();
    if (knots > most_knots) {
      findings.error(node, "the curves up to here turn more than a road network can",
                     "check lengths and curvatures");
      network.roads.clear();
      return;
    }
  }
  if (network.roads.empty()) findings.error(root, "there is no road", "add at least one road");
}

/// The network, complete unless the findings hold an error.
RoadNetwork read_network(XmlFindings& findings, std::string_view xml) {
  RoadNetwork network;
  if (xml.size() > largest_text) {
    findings.error_at(-1, fmt::format("the text is {} MiB long", xml.size() >> 20),
                      "split it into files below 512 MiB");
    return network;
  }
  pugi::xml_document document;
  const auto result = document.load_buffer(xml.data(), xml.size());
  if (!result) {
    findings.error_at(result.offset,
                      fmt::format("it is no well-formed XML: {}", result.description()),
                      "repair the XML there");
    return network;
  }
  const auto root = document.child("OpenDRIVE");
  if (!root) {
    findings.error_at(0, "the root element is not <OpenDRIVE>",
                      "give an ASAM OpenDRIVE file (.xodr)");
    return network;
  }
  const HeaderOffset offset = read_header(findings, root, network.header);
  read_roads(findings, root, offset, network);
  if (findings.has_error() && network.roads.empty()) return network;
  link_network(findings, root, network);
  if (findings.has_error()) return network;
  check_lane_links(findings, root, network);
  build_spatial_index(network);
  return network;
}

}  // namespace

Expected<RoadNetwork> read_opendrive(std::string_view xml, std::string_view name,
                                     std::vector<Finding>* warnings) {
  XmlFindings findings(xml, name);
  RoadNetwork network = read_network(findings, xml);
  if (findings.has_error()) return tl::unexpected(findings.first_error());
  if (warnings != nullptr) {
    const auto found = findings.findings();
    warnings->insert(warnings->end(), found.begin(), found.end());
  }
  return network;
}

std::vector<Finding> check_opendrive(std::string_view xml, std::string_view name) {
  XmlFindings findings(xml, name);
  read_network(findings, xml);
  return findings.findings();
}

}  // namespace septet::road
