#pragma once
/// An experiment as data (docs/experiments.md): groups, parts, conditions, their order and their seeds.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::logging {

/// Drivers of one kind.
struct ExperimentGroup {
  std::string name;
  int subjects = 0;
  std::string driver;  ///< Name of a simulated driver; empty: people.
  /// Time at which simulated drivers end free play, minutes: a normal distribution, an assumption and no finding.
  /// Empty: never.
  std::optional<double> stops_mean_min;
  double stops_sd_min = 0.0;
};

/// One part, taken by every participant.
struct ExperimentPart {
  std::string name, scenario;
  double seconds = 0.0;  ///< Single drive: its length, or less if the scenario ends.
  double up_to_s = 0.0;  ///< Free play: drives are repeated until the driver stops, at most for this time.
  std::vector<std::string> parameters;
  bool is_free() const { return up_to_s > 0.0; }
};

struct ExperimentCondition {
  std::string name;
  std::vector<std::string> parameters;
};

enum class ConditionOrder { counterbalanced, as_listed };

struct Experiment {
  std::string title, note;
  std::uint64_t seed = 1;
  std::string log = "samples", rig = "desktop";
  std::vector<ExperimentGroup> groups;
  std::vector<ExperimentPart> parts;
  std::vector<ExperimentCondition> conditions;  ///< A single one without a name if the file has no conditions.
  ConditionOrder order = ConditionOrder::counterbalanced;
  std::vector<std::string> questionnaires;  ///< Questionnaires after the last drive, for every participant.
  std::vector<std::string> questionnaires_after_each_condition;
};

Expected<Experiment> read_experiment(std::string_view toml, std::string_view name);

/// One part under one condition.
struct PlannedDrive {
  std::size_t part = 0, condition = 0;  ///< Indices into the experiment's.
  double seconds = 0.0;                 ///< Longest duration; for free play until the driver stops.
  bool stops = false;                   ///< Free play: the driver stops before the offered time is over.
};

struct PlannedSubject {
  std::string participant;  ///< "P01", …
  std::size_t number = 0, group = 0;
  std::vector<PlannedDrive> drives;
};

/// All participants, in turn. The same experiment gives the same plan.
std::vector<PlannedSubject> plan_of(const Experiment& experiment);

/// Orders in which each of `count` conditions comes as often in each place and, for an even number, as often after each
/// other one: Williams 1949. An odd number needs twice as many orders, the second half being the first reversed.
std::vector<std::vector<std::size_t>> balanced_orders(std::size_t count);

/// Seed of the `lap`th drive of a part, from 0: derived from the experiment's seed, so that one drive can be repeated
/// alone.
std::uint64_t drive_seed(const Experiment& experiment, std::size_t subject, const PlannedDrive& drive, std::size_t lap);

/// "game-01", "game-rain-01": the folder of a drive.
std::string drive_name(const Experiment& experiment, const PlannedDrive& drive, std::size_t lap);

}  // namespace septet::logging
