#pragma once
/// Simulated subjects' drives, some at once.

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "command-line/command/experiment_ranks.hpp"
#include "command-line/command/experiment_study.hpp"
#include "engine/core/expected.hpp"
#include "program/console.hpp"

namespace septet::server {

struct RunningDrive;

class ExperimentRun {
 public:
  /// `others`: programs that mpirun has started drive too; null: nobody.
  ExperimentRun(const Study& study, const ExperimentOptions& options, program::Machines* others = nullptr);
  ~ExperimentRun();

  std::size_t subjects() const { return stands_.size(); }
  std::size_t finished() const { return finished_; }
  double driven_now_s() const { return done_s_ - found_s_; }
  double wall_s() const;

  /// Until all are finished, somebody stops it, or a drive fails, which is said once: what stops one stops the others too.
  Expected<void> go_on();

 private:
  Expected<void> take_ended();
  /// Starts the next waiting subject's drive, here or elsewhere; false: nobody is free.
  Expected<bool> start_next();
  /// The drive at this place of those that are going on has ended.
  Expected<void> take(RunningDrive drive, const program::ChildExit& exit);
  void show();

  const Study& study_;
  std::map<std::size_t, Stand> stands_;
  std::vector<std::size_t> waiting_;
  std::vector<RunningDrive> running_;
  std::optional<ExperimentRanks> others_;
  std::size_t jobs_ = 1, finished_ = 0;
  double total_s_ = 0.0, done_s_ = 0.0, found_s_ = 0.0, begun_s_ = 0.0;
  program::ProgressLine progress_;
};

}  // namespace septet::server
