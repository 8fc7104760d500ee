#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "engine/core/regular_file.hpp"
#include "engine/scenario/read/scenario_reading.hpp"

namespace septet::scenario {
namespace {

/// Reads every file of the catalog folders once and keeps their <Catalog> elements by name.
void load_catalogs(Reading& reading, const Element& where) {
  if (reading.catalogs_loaded) return;
  reading.catalogs_loaded = true;
  for (const auto& [kind, folder] : reading.catalog_locations) {
    const auto paths = reading.files.list(folder);
    if (!paths) {
      where.warning(fmt::format("catalog folder {}: {}", folder, paths.error().what), paths.error().remedy);
      continue;
    }
    for (const std::string& path : *paths) {
      const auto text = reading.files.read(path);
      if (!text) {
        where.error(fmt::format("catalog {}: {}", path, text.error().what), text.error().remedy);
        continue;
      }
      auto file = parse_xml(*text, path);
      const Element root = root_of(*file);
      const Element catalog = root.child("Catalog");
      root.child("FileHeader").ignore();
      if (catalog) reading.catalogs.emplace(catalog.text("name"), catalog);
      reading.xml_files.push_back(std::move(file));
    }
  }
}

}  // namespace

void check_catalog(Reading& reading, const Element& catalog) {
  reading.names_are_elsewhere = true;
  catalog.text("name");
  for (const Element& found : catalog.all_children()) {
    const std::string kind = found.name();
    const Element entry = with_declared_parameters(found);
    if (kind == "Vehicle" || kind == "Pedestrian" || kind == "MiscObject") {
      Entity entity;
      read_object(entry.mark(), entity);
    } else if (kind == "Environment") {
      read_environment(entry.mark());
    } else if (kind == "Maneuver") {
      check_maneuver(reading, entry.mark());
    } else if (kind == "Trajectory") {
      read_trajectory(reading, entry.mark());
    } else if (kind == "Route") {
      read_route(reading, entry.mark());
    } else if (kind == "Controller") {
      entry.text("name");
      entry.ignore();
    }
  }
}

Element resolve_catalog_reference(Reading& reading, const Element& parent,
                                  std::initializer_list<std::string_view> kinds) {
  const Element reference = parent.child("CatalogReference");
  if (!reference) return {};
  load_catalogs(reading, reference);
  const std::string catalog_name = reference.text("catalogName"), entry_name = reference.text("entryName");
  Parameters assigned;
  for (const Element& assignment : reference.child("ParameterAssignments").children("ParameterAssignment")) {
    assigned[assignment.parameter_name("parameterRef")] = assignment.text_or("value", "");
  }
  const auto found = reading.catalogs.find(catalog_name);
  if (found == reading.catalogs.end()) {
    reference.error(fmt::format("no catalog is named \"{}\"", catalog_name),
                    "name the folder that holds it in <CatalogLocations>");
    return {};
  }
  for (const Element& entry : found->second.all_children()) {
    if (std::find(kinds.begin(), kinds.end(), entry.name()) == kinds.end()) continue;
    if (entry.label("name") != entry_name) continue;
    auto& used = reading.used_entries;
    if (std::find(used.begin(), used.end(), entry) == used.end()) used.push_back(entry);
    return with_declared_parameters(entry.mark(), assigned);
  }
  reference.error(fmt::format("catalog {} has no <{}> named \"{}\"", catalog_name, *kinds.begin(), entry_name),
                  "correct entryName, or add the entry to the catalog");
  return {};
}

ScenarioFiles files_in(const std::string& folder) {
  namespace fs = std::filesystem;
  ScenarioFiles files;
  files.read = [folder](const std::string& path) -> Expected<std::string> {
    return read_regular_file(fs::path(folder) / path);
  };
  files.list = [folder](const std::string& path) -> Expected<std::vector<std::string>> {
    std::error_code problem;
    std::vector<std::string> found;
    for (fs::directory_iterator at(fs::path(folder) / path, problem), end; !problem && at != end;
         at.increment(problem)) {
      if (at->path().extension() == ".xosc") found.push_back((fs::path(path) / at->path().filename()).string());
    }
    if (problem) return failure(problem.message(), path, "check the folder's name and rights");
    std::sort(found.begin(), found.end());
    return found;
  };
  return files;
}

}  // namespace septet::scenario
