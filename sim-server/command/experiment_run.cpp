#include "sim-server/command/experiment_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/core.h>

#include "engine/core/printable.hpp"
#include "program/child_process.hpp"
#include "program/clock.hpp"
#include "program/resources.hpp"
#include "program/stop_signal.hpp"
#include "sim-server/command/experiment_results.hpp"

namespace septet::server {
namespace fs = std::filesystem;
using namespace std::chrono_literals;
using logging::PlannedDrive, logging::PlannedSubject;

/// A drive that is going on.
struct RunningDrive {
  std::size_t subject = 0;
  fs::path folder, log;
  program::ChildProcess process;
};

namespace {

std::string last_line(const fs::path& file) {
  std::ifstream in(file);
  std::string line, last;
  while (std::getline(in, line))
    if (!line.empty()) last = line;
  return printable(last);
}

Expected<RunningDrive> start_drive(const Study& study, std::size_t index, const Stand& stand) {
  const PlannedSubject& subject = study.plan[index];
  const PlannedDrive& drive = subject.drives[stand.drive];
  const fs::path folder = drive_folder(study, subject, drive, stand.lap), log = folder.string() + ".log";
  std::error_code error;
  fs::remove_all(folder, error);  // What a run that was stopped has left.
  fs::create_directories(folder.parent_path(), error);
  if (error) return failure(error.message(), folder.string(), "free some space, or choose another folder with --out");
  const double seconds = drive.seconds - stand.done_s;
  auto arguments = drive_arguments(study.experiment, subject, stand.drive, stand.lap, seconds, folder);
  arguments.insert(arguments.begin(), {"drive", "--no-screens"});
  auto process = program::ChildProcess::start({.program = (program::own_folder() / "septet").string(),
                                               .arguments = std::move(arguments),
                                               .environment = {},
                                               .log = log});
  if (!process) return tl::unexpected(process.error());
  return RunningDrive{index, folder, log, std::move(*process)};
}

double planned_s(const PlannedSubject& subject) {
  double sum_s = 0.0;
  for (const PlannedDrive& drive : subject.drives) sum_s += drive.seconds;
  return sum_s;
}

}  // namespace

ExperimentRun::ExperimentRun(const Study& study, const ExperimentOptions& options) : study_(study) {
  for (std::size_t i = 0; i < study.plan.size(); ++i) {
    if (!options.only.empty() && study.plan[i].participant != options.only) continue;
    stands_[i] = stand_of(study, study.plan[i]);
    total_s_ += planned_s(study.plan[i]);
    done_s_ += stands_[i].total_s;
    if (stands_[i].is_finished)
      ++finished_;
    else
      waiting_.push_back(i);
  }
  // The longest first: the end is not spent on one of them alone.
  std::ranges::stable_sort(waiting_, std::greater{},
                           [&](std::size_t i) { return planned_s(study.plan[i]) - stands_[i].total_s; });
  jobs_ = options.jobs > 0 ? options.jobs : std::max(1u, std::thread::hardware_concurrency());
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
    while (running_.size() < jobs_ && !waiting_.empty()) {
      const std::size_t next = waiting_.front();
      auto drive = start_drive(study_, next, stands_[next]);
      if (!drive) return tl::unexpected(drive.error());
      waiting_.erase(waiting_.begin());
      running_.push_back(std::move(*drive));
    }
    if (auto ended = take_ended(); !ended) return ended;
    show();
    std::this_thread::sleep_for(10ms);
  }
  return {};
}

Expected<void> ExperimentRun::take_ended() {
  for (auto it = running_.begin(); it != running_.end();) {
    while (it->process.read_line(0ms)) {
    }
    const auto exit = it->process.poll();
    if (!exit) {
      ++it;
      continue;
    }
    const std::size_t subject = it->subject;
    const FoundDrive found = find_drive(it->folder);
    if (!found.is_whole || found.simulated_s < least_drive_s / 2.0) {
      const fs::path log = it->log;
      const std::string why = last_line(log);
      running_.clear();
      return failure(
          fmt::format("a drive of {} did not come to its end ({}){}", study_.plan[subject].participant,
                      exit->signal != 0 ? fmt::format("signal {}", exit->signal) : fmt::format("status {}", exit->code),
                      why.empty() ? "" : ": " + why),
          log.string(), "mend that and give the command again: finished drives are kept, the others are driven anew");
    }
    std::error_code ignored;
    fs::remove(it->log, ignored);
    fs::remove(it->folder / "screens", ignored);
    it = running_.erase(it);
    const double before_s = stands_[subject].total_s;
    stands_[subject] = stand_of(study_, study_.plan[subject]);
    done_s_ += stands_[subject].total_s - before_s;
    if (!stands_[subject].is_finished) {
      waiting_.insert(waiting_.begin(), subject);
      continue;
    }
    if (auto noted = note_playing_time(study_, study_.plan[subject]); !noted) return noted;
    ++finished_;
  }
  return {};
}

void ExperimentRun::show() {
  const double now_s = wall_s();
  if (!progress_.is_due(now_s)) return;
  const double rate = now_s > 0.0 ? driven_now_s() / now_s : 0.0;
  // Drives that end earlier than they might are why the rest is at most that long.
  const std::string left = rate > 0.0
                               ? fmt::format("at most {:.0f} min left", std::ceil((total_s_ - done_s_) / rate / 60.0))
                               : std::string("time left not known yet");
  progress_.show(fmt::format("{} of {} subjects, {:.2f} of {:.2f} h driven, {:.0f} times as fast as real time, {}",
                             finished_, stands_.size(), done_s_ / 3600.0, total_s_ / 3600.0, rate, left));
}

}  // namespace septet::server
