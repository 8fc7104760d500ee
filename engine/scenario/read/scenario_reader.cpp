#include "engine/scenario/read/scenario_reader.hpp"

#include <fmt/format.h>

#include "engine/scenario/read/scenario_reading.hpp"

namespace septet::scenario {
namespace {

void read_header(const Element& root, FileHeader& header) {
  const Element element = root.required("FileHeader");
  if (!element) return;
  header.revision_major = element.integer("revMajor", 0, 1000);
  header.revision_minor = element.integer("revMinor", 0, 1000);
  header.description = element.text_or("description", "");
  header.author = element.text_or("author", "");
  header.date = element.text_or("date", "");
  element.child("License").ignore();
  element.child("Properties").ignore();
  if (header.revision_major != 1) {
    element.error(fmt::format("revision {}.{} is not read", header.revision_major, header.revision_minor),
                  "give an OpenSCENARIO XML file of revision 1.0 to 1.3");
  } else if (header.revision_minor > 3) {
    element.warning(fmt::format("revision 1.{} is newer than 1.3", header.revision_minor),
                    "expect what is new in it to be ignored");
  }
}

void read_catalog_locations(Reading& reading, const Element& locations) {
  for (const Element& location : locations.all_children()) {
    const Element directory = location.mark().child("Directory");
    if (directory) reading.catalog_locations.emplace_back(location.name(), directory.text("path"));
  }
}

/// Reads the standard's files that are no scenarios; returns true where it was one.
bool read_other_definition(Reading& reading, const Element& root) {
  if (const Element catalog = root.child("Catalog")) {
    if (reading.checking)
      check_catalog(reading, catalog);
    else
      root.error("this is a catalog, not a scenario", "give a scenario that refers to it");
    return true;
  }
  if (const Element distribution = root.child("ParameterValueDistribution")) {
    if (reading.checking)
      check_distribution(reading, distribution);
    else
      root.error(
          "this varies the parameters of a scenario and is none itself",
          fmt::format("give the scenario {} and its parameters", distribution.child("ScenarioFile").text("filepath")));
    return true;
  }
  return false;
}

void read_definition(Reading& reading, const Element& root) {
  if (!root) return;
  if (root.name() != "OpenSCENARIO") {
    root.error("this is not an OpenSCENARIO file", "give a file whose root is <OpenSCENARIO>");
    return;
  }
  read_header(root, reading.scenario.header);
  if (read_other_definition(reading, root)) return;
  read_values(reading, root);
  read_catalog_locations(reading, root.child("CatalogLocations"));
  const Element roads = root.required("RoadNetwork");
  const char* name_road = "add <LogicFile filepath=\"….xodr\"/>";
  const Element logic = roads.child("LogicFile");
  if (logic)
    reading.scenario.road_file = logic.text("filepath");
  else if (roads && reading.checking)
    roads.warning("it names no road, so that the scenario cannot be driven", name_road);
  else if (roads)
    roads.error("it names no road, so that the scenario cannot be driven", name_road);
  // Septet draws the road from the OpenDRIVE file itself.
  roads.child("SceneGraphFile").ignore();
  read_signals(reading, roads.child("TrafficSignals"));
  read_entities(reading, root.required("Entities"));
  if (const Element storyboard = root.required("Storyboard")) read_storyboard(reading, storyboard);
  if (reading.checking && logic) check_on_road(reading, logic);
}

struct Outcome {
  Scenario scenario;
  std::vector<Finding> findings;
};

Outcome read(std::string_view xml, std::string_view name, const ScenarioFiles& files,
             const std::vector<ParameterValue>& parameters, bool checking) {
  Reading reading{files};
  reading.checking = checking;
  reading.xml_files.push_back(parse_xml(xml, std::string(name)));
  const Element root = with_outside_parameters(root_of(*reading.xml_files.front()), parameters);
  read_definition(reading, root);
  if (root) root.report_unread();
  for (const Element& entry : reading.used_entries) entry.report_unread();

  Outcome outcome{std::move(reading.scenario), {}};
  for (const auto& file : reading.xml_files) {
    const auto found = findings_of(*file).findings();
    outcome.findings.insert(outcome.findings.end(), found.begin(), found.end());
  }
  return outcome;
}

}  // namespace

Expected<ParameterValue> parse_parameter(std::string_view text) {
  const auto equals = text.find('=');
  if (equals == 0 || equals == text.npos) {
    return failure(fmt::format("\"{}\" gives no parameter a value", text.substr(0, 60)), "parameter",
                   "write NAME=VALUE");
  }
  return ParameterValue{std::string(text.substr(0, equals)), std::string(text.substr(equals + 1))};
}

std::optional<EntityIndex> find_entity(const Scenario& scenario, std::string_view name) {
  for (EntityIndex i = 0; i < scenario.entities.size(); ++i) {
    if (scenario.entities[i].name == name) return i;
  }
  return std::nullopt;
}

Expected<Scenario> read_scenario(std::string_view xml, std::string_view name, const ScenarioFiles& files,
                                 std::vector<Finding>* warnings, const std::vector<ParameterValue>& parameters) {
  Outcome outcome = read(xml, name, files, parameters, false);
  for (Finding& finding : outcome.findings) {
    if (finding.severity == Severity::error) return tl::unexpected(std::move(finding.error));
    if (warnings != nullptr) warnings->push_back(std::move(finding));
  }
  return std::move(outcome.scenario);
}

std::vector<Finding> check_scenario(std::string_view xml, std::string_view name, const ScenarioFiles& files) {
  return read(xml, name, files, {}, true).findings;
}

}  // namespace septet::scenario
