#include "command-line/command/experiment_run.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "command-line/command/experiment_progress.hpp"
#include "command-line/command/experiment_results.hpp"
#include "engine/core/printable.hpp"
#include "program/child_process.hpp"
#include "program/clock.hpp"
#include "program/resources.hpp"
#include "program/stop_signal.hpp"

namespace septet::server {
namespace fs = std::filesystem;
using namespace std::chrono_literals;
using logging::PlannedDrive, logging::PlannedSubject;

/// A drive that is going on.
struct RunningDrive {
  std::size_t subject = 0;
  fs::path folder, log;
  std::optional<program::ChildProcess> process;  ///< Empty: another program drives it.
  std::uint64_t elsewhere = 0;                   ///< Its number there.
};

namespace {

std::string last_line(const fs::path& file) {
  std::ifstream in(file);
  std::string line, last;
  while (std::getline(in, line))
    if (!line.empty()) last = line;
  return printable(last);
}

/// Specification of a drive before it starts. Removes the remains of a stopped run.
struct NextDrive {
  fs::path folder, log;
  std::vector<std::string> arguments;
};

Expected<NextDrive> next_drive(const Study& study, std::size_t index, const Stand& stand) {
  const PlannedSubject& subject = study.plan[index];
  const PlannedDrive& drive = subject.drives[stand.drive];
  const fs::path folder = drive_folder(study, subject, drive, stand.lap);
  std::error_code error;
  fs::remove_all(folder, error);
  fs::create_directories(folder.parent_path(), error);
  if (error) return failure(error.message(), folder.string(), "free some space, or choose another folder with --out");
  const double seconds = drive.seconds - stand.done_s;
  return NextDrive{folder, folder.string() + ".log",
                   drive_arguments(study.experiment, subject, stand.drive, stand.lap, seconds, folder)};
}

double planned_s(const PlannedSubject& subject) {
  double sum_s = 0.0;
  for (const PlannedDrive& drive : subject.drives) sum_s += drive.seconds;
  return sum_s;
}

}  // namespace

ExperimentRun::ExperimentRun(const Study& study, const ExperimentOptions& options, program::Machines* others)
    : study_(study) {
  if (others) others_.emplace(*others);
  for (std::size_t i = 0; i < study.plan.size(); ++i) {
    if (!options.only.empty() && study.plan[i].participant != options.only) continue;
    stands_[i] = stand_of(study, study.plan[i]);
    if (stands_[i].is_forgotten) {
      ++finished_;
      continue;
    }
    total_s_ += planned_s(study.plan[i]);
    done_s_ += stands_[i].total_s;
    if (stands_[i].is_finished)
      ++finished_;
    else
      waiting_.push_back(i);
  }
  // The longest first, so that it does not run alone at the end.
  std::ranges::stable_sort(waiting_, std::greater{},
                           [&](std::size_t i) { return planned_s(study.plan[i]) - stands_[i].total_s; });
  const unsigned here = others ? program::share_of_processors() : std::max(1u, std::thread::hardware_concurrency());
  jobs_ = options.jobs > 0 ? options.jobs : here;
  begun_s_ = program::monotonic_s();
  found_s_ = done_s_;
}

ExperimentRun::~ExperimentRun() = default;

double ExperimentRun::wall_s() const { return program::monotonic_s() - begun_s_; }

Expected<void> ExperimentRun::go_on() {
  while (!waiting_.empty() || !running_.empty()) {
    if (program::stop_signal()) {
      program::obey_stop_signal();
      running_.clear();
      return {};
    }
    while (!waiting_.empty()) {
      const auto started = start_next();
      if (!started) return tl::unexpected(started.error());
      if (!*started) break;
    }
    if (auto ended = take_ended(); !ended) return ended;
    show();
    std::this_thread::sleep_for(10ms);
  }
  return {};
}

Expected<bool> ExperimentRun::start_next() {
  const std::size_t index = waiting_.front();
  const auto here =
      std::ranges::count_if(running_, [](const RunningDrive& drive) { return drive.process.has_value(); });
  const bool is_free = static_cast<std::size_t>(here) < jobs_;
  if (!is_free && !(others_ && others_->has_room())) return false;
  auto next = next_drive(study_, index, stands_[index]);
  if (!next) return tl::unexpected(next.error());
  clear_half_drive(next->folder);
  RunningDrive drive{.subject = index, .folder = next->folder, .log = next->log, .process = {}, .elsewhere = 0};
  if (is_free) {
    next->arguments.insert(next->arguments.begin(), {"drive", "--no-screens"});
    auto process = program::ChildProcess::start({.program = (program::own_folder() / "septet").string(),
                                                 .arguments = std::move(next->arguments),
                                                 .environment = {},
                                                 .log = next->log});
    if (!process) return tl::unexpected(process.error());
    drive.process = std::move(*process);
  } else {
    const auto number = others_->deal(next->arguments, next->folder);
    if (!number) return false;
    drive.elsewhere = *number;
  }
  waiting_.erase(waiting_.begin());
  running_.push_back(std::move(drive));
  return true;
}

Expected<void> ExperimentRun::take_ended() {
  for (std::size_t i = 0; i < running_.size();) {
    auto& process = running_[i].process;
    while (process && process->read_line(0ms)) {
    }
    const auto exit = process ? process->poll() : std::nullopt;
    if (!exit) {
      ++i;
      continue;
    }
    RunningDrive drive = std::move(running_[i]);
    running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
    if (auto taken = take(std::move(drive), *exit); !taken) return taken;
  }
  if (!others_) return {};
  const auto ended = others_->take_ended();
  for (const auto& message : others_->take_messages()) progress_.message(message);
  if (!ended) return tl::unexpected(ended.error());
  for (const ExperimentRanks::Ended& end : *ended) {
    const auto found = std::ranges::find_if(
        running_, [&](const RunningDrive& drive) { return !drive.process && drive.elsewhere == end.drive; });
    if (found == running_.end()) continue;
    RunningDrive drive = std::move(*found);
    running_.erase(found);
    if (end.is_lost) {
      waiting_.insert(waiting_.begin(), drive.subject);
      continue;
    }
    if (auto taken = take(std::move(drive), end.exit); !taken) return taken;
  }
  return {};
}

Expected<void> ExperimentRun::take(RunningDrive drive, const program::ChildExit& exit) {
  const std::size_t subject = drive.subject;
  const FoundDrive found = find_drive(drive.folder);
  if (!found.is_whole || found.simulated_s < least_drive_s / 2.0) {
    const std::string why = last_line(drive.log);
    running_.clear();
    return failure(
        fmt::format("a drive of {} did not come to its end ({}){}", study_.plan[subject].participant,
                    exit.signal != 0 ? fmt::format("signal {}", exit.signal) : fmt::format("status {}", exit.code),
                    why.empty() ? "" : ": " + why),
        drive.log.string(),
        "mend that and give the command again: finished drives are kept, the others are driven anew");
  }
  std::error_code ignored;
  fs::remove(drive.log, ignored);
  fs::remove(drive.folder / "screens", ignored);
  const double before_s = stands_[subject].total_s;
  stands_[subject] = stand_of(study_, study_.plan[subject]);
  done_s_ += stands_[subject].total_s - before_s;
  if (!stands_[subject].is_finished) {
    waiting_.insert(waiting_.begin(), subject);
    return {};
  }
  if (auto noted = note_playing_time(study_, study_.plan[subject]); !noted) return noted;
  ++finished_;
  return {};
}

void ExperimentRun::show() {
  const double now_s = wall_s();
  if (!progress_.is_due(now_s)) return;
  progress_.show(text_of({.finished = finished_,
                          .subjects = stands_.size(),
                          .driven_s = done_s_,
                          .planned_s = total_s_,
                          .driven_now_s = driven_now_s(),
                          .wall_s = now_s}));
}

}  // namespace septet::server
