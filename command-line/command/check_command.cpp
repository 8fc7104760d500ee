#include "command-line/command/check_command.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <ostream>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "command-line/command/check_model.hpp"
#include "command-line/command/check_rig.hpp"
#include "command-line/command/experiment_inputs.hpp"
#include "engine/core/regular_file.hpp"
#include "engine/document/json.hpp"
#include "engine/document/toml_table.hpp"
#include "engine/film_script/film_script.hpp"
#include "engine/physics/vehicle/read_vehicle.hpp"
#include "engine/road/opendrive_reader.hpp"
#include "engine/scenario/read/scenario_reader.hpp"
#include "logging/session/session_reader.hpp"
#include "logging/session/whole_session.hpp"
#include "logging/study/experiment/design.hpp"
#include "logging/study/lesson/lesson.hpp"
#include "logging/study/questionnaire.hpp"
#include "program/clock.hpp"
#include "program/console.hpp"
#include "sim-server/drive/drive_loader.hpp"

namespace septet::server {
namespace {

using road::Finding;
using road::Severity;

/// Faults of one file, and its detected kind.
struct Checked {
  std::string file, kind;
  std::vector<Finding> findings;
  std::vector<std::string> found;  ///< Of a model: its contents, a sentence each.

  std::size_t count(Severity severity) const {
    return static_cast<std::size_t>(std::ranges::count(findings, severity, &Finding::severity));
  }
};

/// The line in "file:12, <element>"; 0 if there is none.
int line_in(const std::string& where, const std::string& file) {
  if (!where.starts_with(file + ":")) return 0;
  return std::atoi(where.c_str() + file.size() + 1);
}

template <class Value>
void add_error(const Expected<Value>& result, Checked& checked) {
  if (result) return;
  checked.findings.push_back({Severity::error, line_in(result.error().where, checked.file), result.error()});
}

/// Checks an experiment with the inputs of its drives, as `septet experiment` finds them.
void check_experiment(const std::string& text, Checked& checked) {
  const auto experiment = logging::read_experiment(text, checked.file);
  add_error(experiment, checked);
  if (experiment) add_error(read_inputs(*experiment), checked);
}

void check_toml(const std::string& text, Checked& checked) {
  const auto keys = document::top_keys_of_toml(text, checked.file);
  const auto has = [&](const char* key) { return keys && std::ranges::find(*keys, key) != keys->end(); };
  const bool is_lesson = checked.file.ends_with(".lesson.toml") || has("task");
  checked.kind = !keys                         ? "TOML"
                 : has("shot")                 ? "film script"
                 : has("body")                 ? "vehicle"
                 : is_lesson                   ? "lesson"
                 : has("item")                 ? "questionnaire"
                 : has("group") || has("part") ? "experiment"
                                               : "rig";
  if (!keys)
    add_error(keys, checked);
  else if (checked.kind == "lesson")
    add_error(logging::read_lesson(text, checked.file), checked);
  else if (checked.kind == "questionnaire")
    add_error(logging::read_questionnaire(text, checked.file), checked);
  else if (checked.kind == "experiment")
    check_experiment(text, checked);
  else if (has("shot"))
    add_error(film::read_script(text, checked.file), checked);
  else if (has("body"))
    add_error(vehicle::read_vehicle(text, checked.file), checked);
  else
    checked.findings = check_rig(text, checked.file);
}

void check_session(Checked& checked) {
  checked.kind = "session";
  const auto session = logging::SessionReader::open(checked.file);
  add_error(session, checked);
  if (!session) return;
  program::ProgressLine progress;
  const auto whole = logging::read_whole(*session, [&](double share) {
    if (progress.is_due(program::monotonic_s()))
      progress.show(fmt::format("{}: {:.0f} % read", checked.file, 100.0 * share));
  });
  progress.close();
  add_error(whole, checked);
  const auto log = session->info().other.find("log");
  const bool has_samples_alone = log != session->info().other.end() && log->second == "samples";
  if (whole && !has_samples_alone) {
    add_error(load_drive(session->info(), checked.file), checked);
    if (whole->snapshots == 0) add_error(session->shown_span_s(), checked);
  }
  const auto warn = [&](const char* what, const char* remedy) {
    checked.findings.push_back({Severity::warning, 0, {what, checked.file, remedy}});
  };
  if (has_samples_alone) warn("it holds no snapshot", "expect nothing to be shown of it");
  if (!session->ended_cleanly())
    warn("its drive was interrupted", "expect the last tenth of a second to be missing");
  else if (whole && !whole->has_digest)
    warn("it has no digest of the recorded data, since an earlier build wrote it",
         "use it, but do not rely on it being unaltered");
}

Checked check_file(const std::string& name) {
  Checked checked{name, "", {}, {}};
  const std::filesystem::path file(name);
  const auto extension = file.extension();
  if (extension == ".sqlite") {
    check_session(checked);
    return checked;
  }
  if (extension == ".glb" || extension == ".gltf") {
    auto [findings, found] = check_model(file);
    return {name, "model", std::move(findings), std::move(found)};
  }
  if (extension != ".xodr" && extension != ".xosc" && extension != ".toml") {
    checked.kind = "unknown";
    checked.findings.push_back({Severity::error,
                                0,
                                {"it is neither .xodr, .xosc, .toml, .glb, .gltf nor .sqlite", name,
                                 "check roads, scenarios, rigs, vehicles, film scripts, lessons, questionnaires, "
                                 "experiments, models or sessions"}});
    return checked;
  }
  checked.kind = extension == ".xodr" ? "road" : extension == ".xosc" ? "scenario" : "TOML";
  const auto text = read_regular_file(file);
  add_error(text, checked);
  if (!text) return checked;
  if (extension == ".xodr") checked.findings = road::check_opendrive(*text, name);
  if (extension == ".xosc")
    checked.findings = scenario::check_scenario(*text, name, scenario::files_in(file.parent_path().string()));
  if (extension == ".toml") check_toml(*text, checked);
  return checked;
}

const char* word(Severity severity) { return severity == Severity::error ? "error" : "warning"; }

void print_lines(const std::vector<Checked>& all, std::size_t errors, std::size_t warnings, std::ostream& out) {
  for (const Checked& checked : all) {
    for (const std::string& found : checked.found) out << fmt::format("found: {}: {}\n", checked.file, found);
    for (const Finding& finding : checked.findings)
      out << word(finding.severity) << ": " << describe(finding.error) << "\n";
  }
  out << fmt::format("{} files, {} errors, {} warnings\n", all.size(), errors, warnings);
}

void print_json(const std::vector<Checked>& all, std::size_t errors, std::size_t warnings, std::ostream& out) {
  using document::Json;
  Json files = Json::array();
  for (const Checked& checked : all) {
    Json findings = Json::array();
    for (const Finding& finding : checked.findings) {
      const Error& error = finding.error;
      Json line = finding.line > 0 ? Json(finding.line) : Json(nullptr);
      findings.push_back({{"severity", word(finding.severity)},
                          {"line", std::move(line)},
                          {"what", error.what},
                          {"where", error.where},
                          {"remedy", error.remedy},
                          {"rule", finding.rule.empty() ? Json(nullptr) : Json(finding.rule)}});
    }
    files.push_back({{"file", checked.file},
                     {"kind", checked.kind},
                     {"errors", checked.count(Severity::error)},
                     {"warnings", checked.count(Severity::warning)},
                     {"found", checked.found},
                     {"findings", std::move(findings)}});
  }
  const Json answer = {{"format", "septet check"},
                       {"version", 1},
                       {"errors", errors},
                       {"warnings", warnings},
                       {"files", std::move(files)}};
  out << document::text_of(answer);
}

}  // namespace

int run_check(const CheckOptions& options, std::ostream& out) {
  std::vector<Checked> all;
  std::size_t errors = 0, warnings = 0;
  for (const auto& file : options.files) {
    const Checked& checked = all.emplace_back(check_file(file));
    errors += checked.count(Severity::error);
    warnings += checked.count(Severity::warning);
  }
  (options.json ? print_json : print_lines)(all, errors, warnings, out);
  return errors + (options.strict ? warnings : 0) == 0 ? 0 : 1;
}

}  // namespace septet::server
