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
  std::size_t jobs = 0;         ///< Drives at once; 0: as many as there are processors.
  std::string only;             ///< One participant's code: nobody else drives, and nothing is pooled.
  unsigned ranks = 0;           ///< Programs of mpirun that drive; 0: one for each of the hosts, or this program alone.
  std::filesystem::path hosts;  ///< In Open MPI's words, a machine a line.
  bool one_of_ranks = false;    ///< Said by the program that has started mpirun.
};

/// Runs what has not been run yet, and pools everybody: subjects.csv, subjects.json, report.html, experiment.json, experiment.toml, and
/// below subjects/CODE the drives. Where mpirun has started several of this program they share the work (experiment_ranks.hpp); with `ranks` or
/// `hosts` this program starts mpirun. Whatever stops it, the next call goes on with the drives that are not whole.
Expected<int> run_experiment(const ExperimentOptions& options);

/// Says who is next, what they drive and by which command, and what is still missing.
Expected<int> run_experiment_next(const ExperimentOptions& options);

}  // namespace septet::server
