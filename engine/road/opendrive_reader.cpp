#include "engine/road/opendrive_reader.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "engine/road/decks.hpp"
#include "engine/road/road_elements.hpp"
#include "engine/road/road_limits.hpp"
#include "engine/road/road_locate.hpp"

namespace septet::road {
namespace {

constexpr std::size_t largest_text = 512u << 20;
/// Limit on the knots of all curves together (plan_curve.hpp), so that a small text cannot demand much memory.
constexpr std::size_t most_knots = 8'000'000;

bool is_whole_number(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

HeaderOffset read_header(XmlFindings& findings, const pugi::xml_node& root, NetworkHeader& header) {
  const auto node = root.child("header");
  if (!node) {
    findings.warning(root, "there is no header", "add <header revMajor=\"1\" revMinor=\"8\"/>",
                     "asam.net:xodr:1.0.0:xml.fileheader_is_present");
    return {};
  }
  constexpr int newest_minor = 8;
  header.revision_major = 1;
  header.revision_minor = newest_minor;
  header.name = node.attribute("name").value();
  header.geo_reference = node.child("geoReference").text().get();
  const auto read_revision = [&](const char* attribute, int& revision) {
    if (is_whole_number(node.attribute(attribute).value())) {
      revision = node.attribute(attribute).as_int();
      return;
    }
    findings.warning(node, fmt::format("{} is missing or no number; the file is read as OpenDRIVE 1.8", attribute),
                     "write revMajor=\"1\" and revMinor=\"4\" to \"8\"", "asam.net:xodr:1.0.0:xml.version_is_defined");
  };
  read_revision("revMajor", header.revision_major);
  read_revision("revMinor", header.revision_minor);
  if (header.revision_major != 1 || header.revision_minor < 4 || header.revision_minor > newest_minor) {
    findings.warning(node, fmt::format("OpenDRIVE {}.{} is read as 1.8", header.revision_major, header.revision_minor),
                     "use a revision from 1.4 to 1.8");
  }
  const auto offset = node.child("offset");
  if (!offset) return {};
  return {{findings.number_or(offset, "x", 0.0, farthest_m), findings.number_or(offset, "y", 0.0, farthest_m)},
          findings.number_or(offset, "z", 0.0, highest_m),
          findings.number_or(offset, "hdg", 0.0)};
}

TrafficRule read_rule(XmlFindings& findings, const pugi::xml_node& node) {
  const std::string_view rule = node.attribute("rule").value();
  if (!rule.empty() && rule != "RHT" && rule != "LHT") {
    findings.error(node, fmt::format("rule=\"{}\" is neither RHT nor LHT", rule.substr(0, 40)), "write RHT or LHT");
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
    if (const auto speed = type.child("speed")) record.speed_limit_mps = read_speed(findings, speed);
    road.types.push_back(std::move(record));
  }
  std::stable_sort(road.types.begin(), road.types.end(), [](const auto& a, const auto& b) { return a.s_m < b.s_m; });
  read_plan(findings, node, offset, road);
  read_elevation(findings, node, offset, road);
  read_lateral(findings, node, road);
  read_lanes(findings, node, road);
  check_surface(findings, node, road);
  read_objects(findings, node, road);
  read_signals(findings, node, road);
  return road;
}

void read_roads(XmlFindings& findings, const pugi::xml_node& root, const HeaderOffset& offset, RoadNetwork& network) {
  std::set<std::string> ids;
  std::size_t knots = 0;
  double length_m = 0.0;
  for (const auto node : root.children("road")) {
    network.roads.push_back(read_road(findings, node, offset));
    const Road& road = network.roads.back();
    if (!ids.insert(road.id).second) {
      findings.error(node, fmt::format("road id {} is used twice", road.id), "give each road its own id");
    }
    length_m += road.length_m;
    if (length_m > longest_network_m) {
      findings.error(node, "the roads up to here are longer than a road network can be",
                     fmt::format("keep all roads together below {} m", longest_network_m));
      network.roads.clear();
      return;
    }
    knots += road.plan.clothoid_knots.size() + road.plan.cubic_knots.size();
    if (knots > most_knots) {
      findings.error(node, "the curves up to here turn more than a road network can", "check lengths and curvatures");
      network.roads.clear();
      return;
    }
  }
  if (network.roads.empty()) findings.error(root, "there is no road", "add at least one road");
}

/// Selects whether a readable file is checked against the checker rules.
enum class Rules : std::uint8_t { left_alone, checked };

/// The network, complete unless the findings hold an error.
RoadNetwork read_network(XmlFindings& findings, std::string_view xml, Rules rules) {
  RoadNetwork network;
  if (xml.size() > largest_text) {
    findings.error_at(-1, fmt::format("the text is {} MiB long", xml.size() >> 20),
                      "split it into files below 512 MiB");
    return network;
  }
  pugi::xml_document document;
  const auto result = document.load_buffer(xml.data(), xml.size());
  if (!result) {
    findings.error_at(result.offset, fmt::format("it is no well-formed XML: {}", result.description()),
                      "repair the XML there", "asam.net:xodr:1.0.0:xml.valid_xml_document");
    return network;
  }
  const auto root = document.child("OpenDRIVE");
  if (!root) {
    findings.error_at(0, "the root element is not <OpenDRIVE>", "give an ASAM OpenDRIVE file (.xodr)",
                      "asam.net:xodr:1.0.0:xml.root_tag_is_opendrive");
    return network;
  }
  const HeaderOffset offset = read_header(findings, root, network.header);
  read_roads(findings, root, offset, network);
  if (findings.has_error() && network.roads.empty()) return network;
  link_network(findings, root, network);
  if (findings.has_error()) return network;
  check_lane_links(findings, root, network);
  if (rules == Rules::checked) check_rules(findings, root, network);
  build_spatial_index(network);
  find_decks(network);
  return network;
}

}  // namespace

Expected<RoadNetwork> read_opendrive(std::string_view xml, std::string_view name, std::vector<Finding>* warnings) {
  XmlFindings findings(xml, name);
  RoadNetwork network = read_network(findings, xml, Rules::left_alone);
  if (findings.has_error()) return tl::unexpected(findings.first_error());
  if (warnings != nullptr) {
    const auto found = findings.findings();
    warnings->insert(warnings->end(), found.begin(), found.end());
  }
  return network;
}

std::vector<Finding> check_opendrive(std::string_view xml, std::string_view name) {
  XmlFindings findings(xml, name);
  read_network(findings, xml, Rules::checked);
  return findings.findings();
}

}  // namespace septet::road
