#pragma once
/// An experiment as data (docs/experiments.md): who drives what, in which order, with which seeds.

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
  std::string driver;  ///< A simulated one; empty: people.
  /// When simulated drivers have had enough of free play, minutes: a normal distribution, an assumption and no finding. Nothing: never.
  std::optional<double> stops_mean_min;
  double stops_sd_min = 0.0;
};

/// One thing that everybody does.
struct ExperimentPart {
  std::string name, scenario;
  double seconds = 0.0;  ///< Once, for so long or until the scenario ends.
  double up_to_s = 0.0;  ///< Or again and again, until the driver has had enough, and no longer than this.
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
  std::vector<ExperimentCondition> conditions;  ///< One without a name where the file has none.
  ConditionOrder order = ConditionOrder::counterbalanced;
  std::vector<std::string> questionnaires;  ///< That everybody is to answer after their last drive.
  std::vector<std::string> questionnaires_after_each_condition;
};

Expected<Experiment> read_experiment(std::string_view toml, std::string_view name);

/// One part under one condition.
struct PlannedDrive {
  std::size_t part = 0, condition = 0;  ///< Of the experiment's.
  double seconds = 0.0;                 ///< How long at most; of free play until they have had enough.
  bool stops = false;                   ///< Free play: before what is offered is over.
};

struct PlannedSubject {
  std::string participant;  ///< "P01", …
  std::size_t number = 0, group = 0;
  std::vector<PlannedDrive> drives;
};

/// Everybody, in turn. The same experiment gives the same plan.
std::vector<PlannedSubject> plan_of(const Experiment& experiment);

/// Orders in which each of `count` conditions comes as often in each place and, of an even number, as often after each other one:
/// Williams 1949. Of an odd number twice as many orders are needed, the second half the first backwards.
std::vector<std::vector<std::size_t>> balanced_orders(std::size_t count);

/// Of the `lap`th drive of a part, from 0: whoever knows the experiment's seed can drive it again alone.
std::uint64_t drive_seed(const Experiment& experiment, std::size_t subject, const PlannedDrive& drive, std::size_t lap);

/// "game-01", "game-rain-01": the folder of a drive.
std::string drive_name(const Experiment& experiment, const PlannedDrive& drive, std::size_t lap);

}  // namespace septet::logging
