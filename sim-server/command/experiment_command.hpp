#pragma once
/// `septet experiment`: simulated subjects, all of them, or people, one after the other (docs/experiments.md).

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "logging/experiment/design.hpp"

namespace septet::server {

struct ExperimentOptions {
  std::string file;           ///< A file, or a name below scenarios/experiments.
  std::filesystem::path out;  ///< Empty: out/NAME.
  std::size_t jobs = 0;       ///< Drives at once; 0: as many as there are processors.
  std::string only;           ///< One participant's code: nobody else drives, and nothing is pooled.
};

/// Runs what has not been run yet, and pools everybody: subjects.csv, subjects.json, report.html, experiment.json, experiment.toml, and
/// below subjects/CODE the drives. Whatever stops it, the next call goes on with the drives that are not whole.
Expected<int> run_experiment(const ExperimentOptions& options);

/// Says who is next, what they drive and by which command, and what is still missing.
Expected<int> run_experiment_next(const ExperimentOptions& options);

/// A drive of the experiment's folder as it was found.
struct FoundDrive {
  bool is_whole = false;  ///< It has ended as it should, and its log is closed.
  bool is_begun = false;  ///< Something of it is there.
  double simulated_s = 0.0;
};
FoundDrive find_drive(const std::filesystem::path& folder);

/// The command line of a drive, without the program.
std::vector<std::string> drive_arguments(const logging::Experiment& experiment, const logging::PlannedSubject& subject,
                                         std::size_t drive, std::size_t lap, double seconds,
                                         const std::filesystem::path& folder);

}  // namespace septet::server
