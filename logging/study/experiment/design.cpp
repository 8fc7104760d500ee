#include "logging/study/experiment/design.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/core.h>
#include <toml++/toml.h>

#include "engine/core/printable.hpp"
#include "engine/core/random.hpp"
#include "engine/document/table_reader.hpp"
#include "engine/document/toml_table.hpp"
#include "logging/study/experiments_document.hpp"

namespace septet::logging {
namespace {

using document::TableReader;

constexpr int most_subjects = 10'000;

/// A word that may be part of a folder's name; may be empty if allowed.
std::string read_name(TableReader& reader, std::string_view key, bool may_be_empty, std::set<std::string>& taken) {
  const std::string name = reader.get_string(key, "");
  constexpr std::string_view usable = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  if ((name.empty() && !may_be_empty) || name.size() > 60 || name.find_first_not_of(usable) != std::string::npos)
    reader.report(key, fmt::format("{} is \"{}\"", key, printable(name, 60)), "use letters, digits, _ and -");
  else if (!taken.insert(name).second)
    reader.report(key, fmt::format("there are two \"{}\"", name), "give each a name of its own");
  return name;
}

/// The table `parameters` as NAME=VALUE.
std::vector<std::string> read_parameters(TableReader& reader) {
  std::vector<std::string> parameters;
  const toml::table* table = reader.get_table("parameters");
  if (!table) return parameters;
  for (const auto& [key, node] : *table) {
    std::string value;
    if (const auto text = node.value_exact<std::string>())
      value = *text;
    else if (const auto whole = node.value_exact<std::int64_t>())
      value = fmt::format("{}", *whole);
    else if (const auto number = node.value_exact<double>())
      value = fmt::format("{}", *number);
    else if (const auto flag = node.value_exact<bool>())
      value = *flag ? "true" : "false";
    else
      reader.report("parameters", fmt::format("parameter {} is neither text nor number", printable(key.str(), 60)),
                    "write parameters = { NAME = 3, OTHER = \"text\" }");
    parameters.push_back(fmt::format("{}={}", key.str(), value));
  }
  return parameters;
}

/// A list of names, taken out of the table.
std::vector<std::string> take_names(toml::table& table, std::string_view key) {
  std::vector<std::string> names;
  const toml::array* array = table.get_as<toml::array>(key);
  if (!array) return names;
  for (const toml::node& node : *array) names.push_back(node.value<std::string>().value_or(""));
  table.erase(key);
  return names;
}

ExperimentGroup read_group(const toml::table& table, std::string_view file, std::set<std::string>& taken,
                           Error& error) {
  TableReader reader(table, file, "group", error);
  ExperimentGroup group;
  group.name = read_name(reader, "name", false, taken);
  group.subjects = static_cast<int>(reader.get_integer("subjects", 0, 0, most_subjects));
  if (group.subjects == 0) reader.report("subjects", "the group has nobody", "say how many, 1 or more");
  group.driver = reader.get_string("driver", "");
  if (table.contains("stops_mean_min")) group.stops_mean_min = reader.get_double("stops_mean_min", 0.0, 0.0, 1e4);
  group.stops_sd_min = reader.get_double("stops_sd_min", 0.0, 0.0, 1e4);
  reader.finish(experiments_document);
  return group;
}

ExperimentPart read_part(const toml::table& table, std::string_view file, std::set<std::string>& taken, Error& error) {
  TableReader reader(table, file, "part", error);
  ExperimentPart part;
  part.name = read_name(reader, "name", false, taken);
  part.scenario = reader.get_string("scenario", "");
  if (part.scenario.empty()) reader.report("scenario", "the part has no scenario", "name one of septet list scenarios");
  part.seconds = reader.get_double("seconds", 0.0, 0.0, 1e6);
  part.up_to_s = 60.0 * reader.get_double("up_to_min", 0.0, 0.0, 1e4);
  if ((part.seconds > 0.0) == (part.up_to_s > 0.0))
    reader.report("seconds", "the part has no duration, or two",
                  "give either seconds (once) or up_to_min (free play), more than 0");
  part.parameters = read_parameters(reader);
  reader.finish(experiments_document);
  return part;
}

ExperimentCondition read_condition(const toml::table& table, std::string_view file, std::set<std::string>& taken,
                                   Error& error) {
  TableReader reader(table, file, "condition", error);
  ExperimentCondition condition;
  condition.name = read_name(reader, "name", false, taken);
  condition.parameters = read_parameters(reader);
  reader.finish(experiments_document);
  return condition;
}

}  // namespace

Expected<Experiment> read_experiment(std::string_view text, std::string_view name) {
  toml::table table;
  {
    auto parsed = document::parse_toml(text, name);
    if (!parsed) return tl::unexpected(parsed.error());
    table = std::move(*parsed);
  }
  Error error;
  Experiment experiment;
  experiment.questionnaires = take_names(table, "questionnaires");
  experiment.questionnaires_after_each_condition = take_names(table, "questionnaires_after_each_condition");
  TableReader reader(table, name, "experiment", error);
  experiment.title = reader.get_string("title", "An experiment");
  experiment.note = reader.get_string("note", "");
  experiment.seed =
      static_cast<std::uint64_t>(reader.get_integer("seed", 1, 0, std::numeric_limits<std::int64_t>::max()));
  experiment.log = reader.get_choice("log", 0, {"samples", "whole"}) == 0 ? "samples" : "whole";
  experiment.rig = reader.get_string("rig", "desktop");
  experiment.order = reader.get_choice("order", 0, {"counterbalanced", "as-listed"}) == 0
                         ? ConditionOrder::counterbalanced
                         : ConditionOrder::as_listed;
  std::set<std::string> groups, parts, conditions;
  for (const auto* group : reader.get_tables("group"))
    experiment.groups.push_back(read_group(*group, name, groups, error));
  for (const auto* part : reader.get_tables("part")) experiment.parts.push_back(read_part(*part, name, parts, error));
  for (const auto* condition : reader.get_tables("condition"))
    experiment.conditions.push_back(read_condition(*condition, name, conditions, error));
  if (experiment.conditions.empty()) experiment.conditions.push_back({});
  if (experiment.groups.empty()) reader.report("group", "nobody takes part", "add a [[group]]");
  if (experiment.parts.empty()) reader.report("part", "nothing is to be done", "add a [[part]]");
  if (experiment.conditions.size() > 20) reader.report("condition", "there are more than 20 conditions", "use fewer");
  reader.finish(experiments_document);
  if (!error.what.empty()) return tl::unexpected(error);
  return experiment;
}

std::vector<std::vector<std::size_t>> balanced_orders(std::size_t count) {
  // The first row is 0, 1, n − 1, 2, n − 2, …; each further row adds 1.
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < count; ++i) first.push_back(i % 2 == 1 ? (i + 1) / 2 : (count - i / 2) % count);
  std::vector<std::vector<std::size_t>> orders;
  for (std::size_t row = 0; row < count; ++row) {
    orders.push_back(first);
    for (std::size_t& condition : orders.back()) condition = (condition + row) % count;
  }
  if (count % 2 == 1 && count > 1)
    for (std::size_t row = 0; row < count; ++row) orders.emplace_back(orders[row].rbegin(), orders[row].rend());
  return orders;
}

std::vector<PlannedSubject> plan_of(const Experiment& experiment) {
  const auto orders = balanced_orders(experiment.conditions.size());
  std::vector<PlannedSubject> plan;
  for (std::size_t group = 0; group < experiment.groups.size(); ++group) {
    const ExperimentGroup& kind = experiment.groups[group];
    for (int i = 0; i < kind.subjects; ++i) {
      PlannedSubject subject;
      subject.number = plan.size() + 1;
      subject.participant = fmt::format("P{:02}", subject.number);
      subject.group = group;
      // Counterbalanced within the group, so that no group has more of one order than of another.
      auto order = experiment.order == ConditionOrder::counterbalanced
                       ? orders[static_cast<std::size_t>(i) % orders.size()]
                       : std::vector<std::size_t>{};
      for (std::size_t k = order.size(); k < experiment.conditions.size(); ++k) order.push_back(k);
      Random random(experiment.seed, subject.number);
      for (const std::size_t condition : order)
        for (std::size_t part = 0; part < experiment.parts.size(); ++part) {
          PlannedDrive drive{part, condition, experiment.parts[part].seconds, false};
          if (experiment.parts[part].is_free()) {
            drive.seconds = experiment.parts[part].up_to_s;
            if (kind.stops_mean_min) {
              // To a tenth of a second; everybody plays for at least a minute.
              const double drawn_s = 60.0 * (*kind.stops_mean_min + kind.stops_sd_min * random.normal());
              const double enough_s = std::max(60.0, std::round(drawn_s * 10.0) / 10.0);
              drive.stops = enough_s < drive.seconds;
              drive.seconds = std::min(drive.seconds, enough_s);
            }
          }
          subject.drives.push_back(drive);
        }
      plan.push_back(std::move(subject));
    }
  }
  return plan;
}

std::uint64_t drive_seed(const Experiment& experiment, std::size_t subject, const PlannedDrive& drive,
                         std::size_t lap) {
  // Short enough to be read out and typed.
  Random random(experiment.seed, (static_cast<std::uint64_t>(subject) << 32) +
                                     (static_cast<std::uint64_t>(drive.part) << 24) +
                                     (static_cast<std::uint64_t>(drive.condition) << 16) + lap + 1);
  return random.next_bits() >> 32;
}

std::string drive_name(const Experiment& experiment, const PlannedDrive& drive, std::size_t lap) {
  const std::string& condition = experiment.conditions[drive.condition].name;
  return fmt::format("{}{}{}-{:02}", experiment.parts[drive.part].name, condition.empty() ? "" : "-", condition,
                     lap + 1);
}

}  // namespace septet::logging
