#pragma once
/// `septet experiment`: simulated subjects, all of them, or people, one after the other (docs/experiments.md).

#include <cstddef>
#include <filesystem>
#include <string>

#include "engine/core/expected.hpp"

namespace septet::server {

struct ExperimentOptions {
  std::string file;             ///< A file, or a name below scenarios/experiments.
  std::filesystem::path out;    ///< Empty: out/NAME.
  std::size_t jobs = 0;         ///< Drives at once; 0: one per processor.
  std::string only;             ///< One participant's code: only they drive, and pooling is skipped.
  unsigned ranks = 0;           ///< Programs of mpirun that drive; 0: one per host, or this program alone.
  std::filesystem::path hosts;  ///< Host file of Open MPI, a machine a line.
  bool one_of_ranks = false;    ///< Set by the program that has started mpirun.
};

/// Runs the missing drives, and pools all subjects: subjects.csv, subjects.json, report.html, experiment.json,
/// experiment.toml, and below subjects/CODE the drives. If mpirun has started several of this program they share the
/// work (experiment_ranks.hpp); with `ranks` or `hosts` this program starts mpirun. After any interruption, the next
/// call goes on with the drives that are not whole.
Expected<int> run_experiment(const ExperimentOptions& options);

/// Prints the next participant, their drive and its command, and the missing answers.
Expected<int> run_experiment_next(const ExperimentOptions& options);

}  // namespace septet::server
