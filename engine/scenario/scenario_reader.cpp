#include "engine/scenario/scenario_reader.hpp"

#include <fmt/format.h>

#include "engine/scenario/scenario_parts.hpp"

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
    element.error(
        fmt::format("revision {}.{} is not read", header.revision_major, header.revision_minor),
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

void read_definition(Reading& reading, const Element& root) {
  if (!root) return;
  if (root.name() != "OpenSCENARIO") {
    root.error("this is not an OpenSCENARIO file", "give a file whose root is <OpenSCENARIO>");
    return;
  }
  read_header(root, reading.scenario.header);
  read_catalog_locations(reading, root.child("CatalogLocations"));
  const Element roads = root.required("RoadNetwork");
  if (const Element logic = roads.child("LogicFile"))
    reading.scenario.road_file = logic.text("filepath");
  else if (roads)
    roads.error("it names no road", "add <LogicFile filepath=\"….xodr\"/>");
  // Septet draws the road from the OpenDRIVE file itself.
  roads.child("SceneGraphFile").ignore();
  read_entities(reading, root.required("Entities"));
  if (const Element storyboard = root.required("Storyboard")) read_storyboard(reading, storyboard);
}

struct Outcome {
  Scenario scenario;
  std::vector<Finding> findings;
};

Outcome read(std::string_view xml, std::string_view name, const ScenarioFiles& files,
             const std::vector<ParameterValue>& parameters) {
  Reading reading{files, {}, {}, {}, {}, false, {}, 1, {}};
  reading.xml_files.push_back(parse_xml(xml, std::string(name)));
  Parameters assigned;
  for (const ParameterValue& parameter : parameters) assigned[parameter.name] = parameter.value;
  const Element root = with_declared_parameters(root_of(*reading.xml_files.front()), assigned);
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

std::optional<EntityIndex> find_entity(const Scenario& scenario, std::string_view name) {
  for (EntityIndex i = 0; i < scenario.entities.size(); ++i) {
    if (scenario.entities[i].name == name) return i;
  }
  return std::nullopt;
}

Expected<Scenario> read_scenario(std::string_view xml, std::string_view name,
                                 const ScenarioFiles& files, std::vector<Finding>* warnings,
                                 const std::vector<ParameterValue>& parameters) {
  Outcome outcome = read(xml, name, files, parameters);
  for (Finding& finding : outcome.findings) {
    if (finding.severity == Severity::error) return tl::unexpected(std::move(finding.error));
    if (warnings != nullptr) warnings->push_back(std::move(finding));
  }
  return std::move(outcome.scenario);
}

std::vector<Finding> check_scenario(std::string_view xml, std::string_view name,
                                    const ScenarioFiles& files) {
  return read(xml, name, files, {}).findings;
}

}  // namespace septet::scenario
