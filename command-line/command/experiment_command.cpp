#include "command-line/command/experiment_command.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "command-line/command/experiment_answers.hpp"
#include "command-line/command/experiment_ranks.hpp"
#include "command-line/command/experiment_results.hpp"
#include "command-line/command/experiment_run.hpp"
#include "command-line/command/experiment_study.hpp"
#include "engine/core/printable.hpp"
#include "program/child_process.hpp"
#include "program/console.hpp"
#include "program/hosts_file.hpp"
#include "program/machines.hpp"
#include "program/run.hpp"
#include "program/stop_signal.hpp"

namespace septet::server {
namespace fs = std::filesystem;
using logging::PlannedDrive, logging::PlannedSubject;

namespace {

Expected<int> run_here(const ExperimentOptions& options, program::Machines* others) {
  const auto study = read_study(options);
  if (!study) return tl::unexpected(study.error());
  for (const auto& group : study->experiment.groups)
    if (group.driver.empty())
      return failure(fmt::format("group {} are people: they drive one after the other", group.name), options.file,
                     "ask who is next with: septet experiment next");
  const auto held = HeldFolder::hold(*study);
  if (!held) return tl::unexpected(held.error());
  program::catch_stop_signals();
  ExperimentRun run(*study, options, others);
  if (auto gone_on = run.go_on(); !gone_on) return tl::unexpected(gone_on.error());
  if (run.finished() < run.subjects()) {
    program::announce(fmt::format("stopped: {} of {} subjects are finished; the same command goes on", run.finished(),
                                  run.subjects()));
    return 3;
  }
  if (run.driven_now_s() > 0.0)
    program::announce(fmt::format("{:.2f} h driven in {:.1f} min, {:.0f} times as fast as real time",
                                  run.driven_now_s() / 3600.0, run.wall_s() / 60.0, run.driven_now_s() / run.wall_s()));
  if (!options.only.empty()) return 0;
  if (auto written = write_study(*study); !written) return tl::unexpected(written.error());
  program::announce(fmt::format("{}: {} subjects; beside it subjects.csv, subjects.json, experiment.json",
                                (study->folder / "report.html").string(), run.subjects()));
  return 0;
}

/// Last line of mpirun's first program, before its exit status: mpirun itself ends with 0 also if that one was killed.
constexpr std::string_view last_words = "septet experiment has ended with status ";

/// Runs the experiment with programs that mpirun starts.
Expected<int> run_by_ranks(const ExperimentOptions& options) {
  const auto mpirun = program::find_mpirun("--ranks");
  if (!mpirun) return tl::unexpected(mpirun.error());
  if (!options.hosts.empty())
    if (auto checked = program::check_hosts_file(options.hosts); !checked) return tl::unexpected(checked.error());
  std::vector<std::string> arguments = program::mpirun_arguments(options.ranks, options.hosts);
  const auto add = [&](std::initializer_list<std::string> more) { arguments.insert(arguments.end(), more); };
  add({(program::own_folder() / "septet").string(), "experiment", options.file, "--one-of-ranks"});
  if (!options.out.empty()) add({"--out", options.out.string()});
  if (!options.only.empty()) add({"--only", options.only});
  if (options.jobs > 0) add({"--jobs", std::to_string(options.jobs)});
  program::catch_stop_signals();
  auto child = program::ChildProcess::start(
      {.program = mpirun->string(), .arguments = std::move(arguments), .environment = {}, .log = {}});
  if (!child) return tl::unexpected(child.error());
  std::optional<int> status;
  // mpirun frames its own words by lines of dashes: its text on a failed start is a page long.
  std::vector<std::string> page;
  bool is_in_page = false;
  for (bool told_to_stop = false;;) {
    const auto exit = child->poll();
    while (const auto line = child->read_line(std::chrono::milliseconds(exit ? 0 : 100))) {
      const std::string_view text = *line;
      const bool is_frame = text.starts_with("----------");
      if (is_frame) is_in_page = !is_in_page;
      if (int number = 0; is_frame || is_in_page)
        page.emplace_back(text);
      else if (!text.starts_with(last_words))
        program::announce(text);
      else if (std::from_chars(text.data() + last_words.size(), text.data() + text.size(), number).ec == std::errc())
        status = number;
    }
    if (exit) break;
    if (!told_to_stop && program::should_stop()) {
      told_to_stop = true;
      child->send_signal(SIGTERM);
    }
  }
  if (status) {
    for (const auto& line : page) program::announce(line);
    return *status;
  }
  const auto words = std::ranges::find_if(
      page, [](const std::string& line) { return !line.starts_with("----------") && !line.empty(); });
  if (!options.hosts.empty() && words != page.end())
    return failure(fmt::format("mpirun could not go on with these machines: {}", printable(*words, 200)),
                   options.hosts.string(),
                   "see that ssh reaches each of them without a password and that this Septet is installed there; "
                   "finished drives are kept");
  return failure("the experiment's first program or mpirun was lost", "--ranks",
                 "give the command again: finished drives are kept");
}

}  // namespace

Expected<int> run_experiment(const ExperimentOptions& options) {
  const auto number = program::number_by_mpirun();
  if (!number && (options.ranks > 0 || !options.hosts.empty())) return run_by_ranks(options);
  if (!number) return run_here(options, nullptr);
  auto machines = program::start_machines();
  if (!machines) return *number > 0 ? Expected<int>(program::failed_status) : tl::unexpected(machines.error());
  if (*number > 0) {
    const int status = drive_for_experiment(**machines, options.jobs);
    (*machines)->will_end_with(status);
    return status;
  }
  auto status = run_here(options, machines->get());
  if (!status) program::say("septet: " + describe(status.error()));
  if (options.one_of_ranks) program::announce(fmt::format("{}{}", last_words, status.value_or(program::failed_status)));
  (*machines)->will_end_with(status.value_or(program::failed_status));
  return status.value_or(program::failed_status);
}

Expected<int> run_experiment_next(const ExperimentOptions& options) {
  const auto study = read_study(options);
  if (!study) return tl::unexpected(study.error());
  const PlannedSubject* next = nullptr;
  Stand stand;
  std::size_t finished = 0, forgotten = 0;
  std::string missing;
  for (const PlannedSubject& subject : study->plan) {
    const Stand own = stand_of(*study, subject);
    finished += own.is_finished;
    forgotten += own.is_forgotten;
    for (const MissingAnswers& due : missing_answers(*study, subject, own))
      missing += fmt::format("  {} has not answered {}{}: {}\n", subject.participant, due.questionnaire,
                             due.condition.empty() ? "" : " after " + due.condition,
                             command_text("septet session answer", {due.session.string(), due.questionnaire}));
    if (own.is_finished || (!options.only.empty() && subject.participant != options.only)) continue;
    if (!next) {
      next = &subject;
      stand = own;
    }
  }
  fmt::print("{} of {} subjects are finished{}\n", finished, study->plan.size(),
             forgotten > 0 ? fmt::format(", {} of them forgotten", forgotten) : "");
  if (!missing.empty()) fmt::print("Missing:\n{}", missing);
  if (!next) return 0;
  std::string order;
  for (std::size_t i = 0; i < next->drives.size(); ++i)
    order += fmt::format("{}{}{}", i ? ", " : "", i == stand.drive ? "→ " : "",
                         drive_name(study->experiment, next->drives[i], i == stand.drive ? stand.lap : 0));
  const PlannedDrive& drive = next->drives[stand.drive];
  const fs::path folder = drive_folder(*study, *next, drive, stand.lap);
  fmt::print("Next: {}, group {}, in this order: {}\n", next->participant, study->experiment.groups[next->group].name,
             order);
  if (find_drive(folder).is_begun)
    fmt::print("The last attempt did not come to its end; it will be moved aside, or say: septet session stop {}\n",
               (folder / "session.sqlite").string());
  fmt::print("  {}\n", command_text("septet drive", drive_arguments(study->experiment, *next, stand.drive, stand.lap,
                                                                    drive.seconds - stand.done_s, folder)));
  return 0;
}

}  // namespace septet::server
