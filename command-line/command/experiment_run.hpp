#pragma once
/// Drives of simulated subjects, several at once.

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
  /// `others`: programs that mpirun has started drive too; null: this program alone.
  ExperimentRun(const Study& study, const ExperimentOptions& options, program::Machines* others = nullptr);
  ~ExperimentRun();

  std::size_t subjects() const { return stands_.size(); }
  std::size_t finished() const { return finished_; }
  double driven_now_s() const { return done_s_ - found_s_; }
  double wall_s() const;

  /// Runs until all are finished, a person stops it, or a drive fails, which is reported once: one stop stops the
  /// others too.
  Expected<void> go_on();

 private:
  Expected<void> take_ended();
  /// Starts the next waiting subject's drive, here or elsewhere; returns false if no program is free.
  Expected<bool> start_next();
  /// Takes the running drive that has ended.
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
