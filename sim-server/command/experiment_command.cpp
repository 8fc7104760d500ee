#include "sim-server/command/experiment_command.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <map>
#include <memory>
#include <thread>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "car-io/simulated_driver/driver_parameters.hpp"
#include "engine/core/printable.hpp"
#include "engine/core/regular_file.hpp"
#include "engine/core/version.hpp"
#include "engine/document/json.hpp"
#include "engine/document/text_file.hpp"
#include "logging/questionnaire.hpp"
#include "logging/report/group_report.hpp"
#include "logging/session_editor.hpp"
#include "logging/session_reader.hpp"
#include "program/child_process.hpp"
#include "program/clock.hpp"
#include "program/console.hpp"
#include "program/resources.hpp"
#include "program/stop_signal.hpp"

namespace septet::server {
namespace fs = std::filesystem;
namespace {

using namespace std::chrono_literals;
using document::Json;
using logging::Experiment, logging::PlannedDrive, logging::PlannedSubject;

/// A remaining time of free play that is shorter than this is not driven.
constexpr double least_drive_s = 1.0;

struct Study {
  Experiment experiment;
  std::string text, name;  ///< The file and what it is called.
  std::vector<PlannedSubject> plan;
  fs::path folder;
};

Expected<void> check_names(const Study& study) {
  for (const auto& group : study.experiment.groups)
    if (!group.driver.empty())
      if (const auto driver = car_io::find_driver(group.driver); !driver) return tl::unexpected(driver.error());
  for (const auto& part : study.experiment.parts)
    if (const auto scenario = program::find_resource(part.scenario, "scenarios", ".xosc"); !scenario)
      return tl::unexpected(scenario.error());
  for (const auto& name : study.experiment.questionnaires)
    if (const auto file = program::find_resource(name, "scenarios/questionnaires", ".toml"); !file)
      return tl::unexpected(file.error());
  return {};
}

Expected<Study> read_study(const ExperimentOptions& options) {
  const auto file = program::find_resource(options.file, "scenarios/experiments", ".toml");
  if (!file) return tl::unexpected(file.error());
  auto text = read_regular_file(*file);
  if (!text) return tl::unexpected(text.error());
  auto experiment = logging::read_experiment(*text, file->string());
  if (!experiment) return tl::unexpected(experiment.error());
  Study study{std::move(*experiment), std::move(*text), file->stem().string(), {}, options.out};
  study.plan = plan_of(study.experiment);
  if (study.folder.empty()) {
    const auto data = program::data_folder();
    if (!data) return tl::unexpected(data.error());
    study.folder = *data / "out" / study.name;
  }
  if (!options.only.empty() &&
      std::ranges::find(study.plan, options.only, &PlannedSubject::participant) == study.plan.end())
    return failure(
        fmt::format("nobody is called \"{}\" in it", printable(options.only, 60)), "--only",
        fmt::format("they are called {} to {}", study.plan.front().participant, study.plan.back().participant));
  if (auto known = check_names(study); !known) return tl::unexpected(known.error());
  return study;
}

fs::path drive_folder(const Study& study, const PlannedSubject& subject, const PlannedDrive& drive, std::size_t lap) {
  return study.folder / "subjects" / subject.participant / drive_name(study.experiment, drive, lap);
}

/// Where a subject stands in the plan.
struct Stand {
  std::size_t drive = 0, lap = 0;
  double done_s = 0.0;   ///< Of this drive's laps.
  double total_s = 0.0;  ///< Of all.
  std::vector<fs::path> sessions;
  bool is_finished = false;
};

/// From what lies in the folder: the whole drives, up to the first that is not.
Stand stand_of(const Study& study, const PlannedSubject& subject) {
  Stand stand;
  for (; stand.drive < subject.drives.size(); ++stand.drive, stand.lap = 0, stand.done_s = 0.0) {
    const PlannedDrive& drive = subject.drives[stand.drive];
    const bool is_free = study.experiment.parts[drive.part].is_free();
    for (;; ++stand.lap) {
      if (is_free ? drive.seconds - stand.done_s < least_drive_s : stand.lap > 0) break;
      const fs::path folder = drive_folder(study, subject, drive, stand.lap);
      const FoundDrive found = find_drive(folder);
      if (!found.is_whole) return stand;
      stand.done_s += found.simulated_s;
      stand.total_s += found.simulated_s;
      stand.sessions.push_back(folder / "session.sqlite");
    }
  }
  stand.is_finished = true;
  return stand;
}

/// The experiment's folder, held until the object goes; a second run in it is refused.
class HeldFolder {
 public:
  static Expected<std::unique_ptr<HeldFolder>> hold(const Study& study) {
    std::error_code error;
    fs::create_directories(study.folder / "subjects", error);
    if (error) return failure(error.message(), study.folder.string(), "choose a folder that can be written with --out");
    auto held = std::make_unique<HeldFolder>();
    held->file_ = ::open(study.folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (held->file_ >= 0 && ::flock(held->file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      return failure("this experiment is being run already", study.folder.string(),
                     "wait for its end, or choose another folder with --out");
    const fs::path own = study.folder / "experiment.toml";
    if (fs::exists(own, error)) {
      const auto earlier = read_regular_file(own);
      if (!earlier) return tl::unexpected(earlier.error());
      if (*earlier != study.text)
        return failure("the folder holds another experiment, or this one before it was changed", study.folder.string(),
                       "choose another folder with --out");
      const auto by = read_regular_file(study.folder / "version.txt");
      if (by && *by != version_text() + '\n')
        return failure(fmt::format("it was begun with Septet {}, and this is {}",
                                   printable(by->substr(0, by->find('\n'))), version_text()),
                       study.folder.string(), "go on with that one, or begin anew with --out");
      return held;
    }
    const auto written = document::write_text_files(
        study.folder, {{"version.txt", version_text() + '\n'}, {"experiment.toml", study.text}});
    if (!written) return tl::unexpected(written.error());
    return held;
  }
  HeldFolder() = default;
  HeldFolder(const HeldFolder&) = delete;
  HeldFolder& operator=(const HeldFolder&) = delete;
  ~HeldFolder() {
    if (file_ >= 0) ::close(file_);
  }

 private:
  int file_ = -1;
};

/// A drive that is going on.
struct Running {
  std::size_t subject = 0;
  fs::path folder, log;
  program::ChildProcess process;
};

std::string last_line(const fs::path& file) {
  std::ifstream in(file);
  std::string line, last;
  while (std::getline(in, line))
    if (!line.empty()) last = line;
  return printable(last);
}

Expected<Running> start_drive(const Study& study, std::size_t index, const Stand& stand) {
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
  return Running{index, folder, log, std::move(*process)};
}

/// For how long somebody played of their own will lies in the last session of it.
Expected<void> note_playing_time(const Study& study, const PlannedSubject& subject) {
  for (const PlannedDrive& drive : subject.drives) {
    if (!study.experiment.parts[drive.part].is_free()) continue;
    double played_s = 0.0;
    fs::path last;
    for (std::size_t lap = 0; drive.seconds - played_s >= least_drive_s; ++lap) {
      const fs::path folder = drive_folder(study, subject, drive, lap);
      const FoundDrive found = find_drive(folder);
      if (!found.is_whole) break;
      played_s += found.simulated_s;
      last = folder / "session.sqlite";
    }
    if (last.empty()) continue;
    const auto reader = logging::SessionReader::open(last);
    if (!reader) return tl::unexpected(reader.error());
    const auto answers = reader->questionnaire();
    if (!answers) return tl::unexpected(answers.error());
    if (std::ranges::find(*answers, "playing_time", &logging::QuestionnaireRecord::item) != answers->end()) continue;
    const logging::QuestionnaireRecord row{"playing_time",
                                           "For how long they played of their own will, s",
                                           std::nullopt,
                                           drive.stops ? std::optional(played_s) : std::nullopt,
                                           played_s,
                                           !drive.stops,
                                           drive.stops ? "had enough (drawn)" : "what was offered was over"};
    if (auto added = logging::add_answers(last, {row}); !added) return added;
  }
  return {};
}

std::string experiment_json(const Study& study) {
  Json json = {{"version", 1},
               {"title", study.experiment.title},
               {"septet", version_text()},
               {"compiler", __VERSION__},
               {"command", fmt::format("septet experiment experiment.toml --out FOLDER")},
               {"seed", study.experiment.seed}};
  json["drives"] = Json::array();
  for (const PlannedSubject& subject : study.plan) {
    for (std::size_t i = 0; i < subject.drives.size(); ++i) {
      const PlannedDrive& drive = subject.drives[i];
      double done_s = 0.0;
      for (std::size_t lap = 0;; ++lap) {
        const fs::path folder = drive_folder(study, subject, drive, lap);
        const FoundDrive found = find_drive(folder);
        if (!found.is_whole) break;
        std::string command = "septet drive --no-screens";
        for (const auto& argument : drive_arguments(study.experiment, subject, i, lap, drive.seconds - done_s,
                                                    fs::relative(folder, study.folder)))
          command += argument.find(' ') == std::string::npos ? ' ' + argument : " '" + argument + '\'';
        const auto summary = read_regular_file(folder / "summary.json");
        const auto parsed = Json::parse(summary.value_or(""), nullptr, false);
        json["drives"].push_back({{"participant", subject.participant},
                                  {"group", study.experiment.groups[subject.group].name},
                                  {"drive", drive_name(study.experiment, drive, lap)},
                                  {"seed", drive_seed(study.experiment, subject.number, drive, lap)},
                                  {"simulated_s", found.simulated_s},
                                  {"state_hash", parsed.is_object() ? parsed.value("state_hash", "") : ""},
                                  {"command", command}});
        done_s += found.simulated_s;
      }
    }
  }
  return document::text_of(json);
}

Expected<void> write_study(const Study& study) {
  std::vector<fs::path> sessions;
  for (const PlannedSubject& subject : study.plan) {
    // A run that was killed just then has not noted it; what is noted stays.
    if (auto noted = note_playing_time(study, subject); !noted) return noted;
    auto own = stand_of(study, subject).sessions;
    sessions.insert(sessions.end(), own.begin(), own.end());
  }
  auto subjects = logging::pool_sessions(sessions, {});
  if (!subjects) return tl::unexpected(subjects.error());
  const auto written = document::write_text_file(study.folder / "experiment.json", experiment_json(study));
  if (!written) return written;
  return logging::write_group_report({.title = study.experiment.title,
                                      .note = study.experiment.note,
                                      .subjects = std::move(*subjects),
                                      .settings = {}},
                                     study.folder);
}

double planned_s(const PlannedSubject& subject) {
  double sum_s = 0.0;
  for (const PlannedDrive& drive : subject.drives) sum_s += drive.seconds;
  return sum_s;
}

/// Everybody's drives, some at once. Answers how many subjects are finished.
class Run {
 public:
  Run(const Study& study, const ExperimentOptions& options) : study_(study) {
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

  std::size_t subjects() const { return stands_.size(); }
  std::size_t finished() const { return finished_; }
  double driven_now_s() const { return done_s_ - found_s_; }
  double wall_s() const { return program::monotonic_s() - begun_s_; }

  /// Until all are finished, somebody stops it, or a drive fails, which is said once: what stops one stops the others too.
  Expected<void> go_on() {
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

 private:
  Expected<void> take_ended() {
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
        return failure(fmt::format("{} did not come to its end ({}){}", it_name(subject),
                                   exit->signal != 0 ? fmt::format("signal {}", exit->signal)
                                                     : fmt::format("status {}", exit->code),
                                   why.empty() ? "" : ": " + why),
                       log.string(),
                       "mend that and give the command again: finished drives are kept, the others are driven anew");
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

  std::string it_name(std::size_t subject) const { return "a drive of " + study_.plan[subject].participant; }

  void show() {
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

  const Study& study_;
  std::map<std::size_t, Stand> stands_;
  std::vector<std::size_t> waiting_;
  std::vector<Running> running_;
  std::size_t jobs_ = 1, finished_ = 0;
  double total_s_ = 0.0, done_s_ = 0.0, found_s_ = 0.0, begun_s_ = 0.0;
  program::ProgressLine progress_;
};

std::string command_text(const std::vector<std::string>& arguments) {
  std::string command = "septet drive";
  for (const auto& argument : arguments)
    command += argument.find(' ') == std::string::npos ? ' ' + argument : " '" + argument + '\'';
  return command;
}

/// Questionnaires that a subject's last session lacks.
std::vector<std::string> missing_answers(const Study& study, const std::vector<fs::path>& sessions) {
  std::vector<std::string> missing = study.experiment.questionnaires;
  for (const fs::path& session : sessions) {
    const auto reader = logging::SessionReader::open(session);
    const auto answers = reader ? reader->questionnaire() : Expected<std::vector<logging::QuestionnaireRecord>>();
    if (!answers) continue;
    std::erase_if(missing, [&](const std::string& name) {
      const std::string prefix = fs::path(name).stem().string();
      return std::ranges::any_of(*answers, [&](const auto& answer) { return answer.item.starts_with(prefix + '.'); });
    });
  }
  return missing;
}

}  // namespace

FoundDrive find_drive(const fs::path& folder) {
  FoundDrive found;
  std::error_code ignored;
  found.is_begun = fs::exists(folder / "session.sqlite", ignored);
  const auto summary = read_regular_file(folder / "summary.json");
  if (!found.is_begun || !summary) return found;
  const auto json = Json::parse(*summary, nullptr, false);
  if (!json.is_object() || json.value("exit_status", -1) != 0 || !json.contains("distance_m")) return found;
  // The summary is written after the session is closed; the side file says that it was not.
  if (fs::exists(folder / "session.sqlite-wal", ignored)) return found;
  const auto reader = logging::SessionReader::open(folder / "session.sqlite");
  if (!reader || !reader->ended_cleanly()) return found;
  found.simulated_s = json.value("simulated_s", 0.0);
  found.is_whole = found.simulated_s > 0.0;
  return found;
}

std::vector<std::string> drive_arguments(const Experiment& experiment, const PlannedSubject& subject, std::size_t drive,
                                         std::size_t lap, double seconds, const fs::path& folder) {
  const PlannedDrive& planned = subject.drives[drive];
  const auto& part = experiment.parts[planned.part];
  const auto& condition = experiment.conditions[planned.condition];
  const auto& group = experiment.groups[subject.group];
  std::vector<std::string> arguments{
      "--scenario",    part.scenario,
      "--rig",         experiment.rig,
      "--seed",        fmt::format("{}", drive_seed(experiment, subject.number, planned, lap)),
      "--seconds",     fmt::format("{:.3f}", seconds),
      "--log",         experiment.log,
      "--participant", subject.participant,
      "--group",       group.name,
      "--part",        part.name,
      "--order",       fmt::format("{}", drive + 1)};
  const auto add = [&](std::initializer_list<std::string> more) { arguments.insert(arguments.end(), more); };
  if (!condition.name.empty()) add({"--condition", condition.name});
  if (!group.driver.empty()) add({"--driver", group.driver});
  for (const auto* parameters : {&part.parameters, &condition.parameters})
    for (const auto& parameter : *parameters) add({"--parameter=" + parameter});
  add({"--out", folder.string()});
  return arguments;
}

Expected<int> run_experiment(const ExperimentOptions& options) {
  const auto study = read_study(options);
  if (!study) return tl::unexpected(study.error());
  for (const auto& group : study->experiment.groups)
    if (group.driver.empty())
      return failure(fmt::format("group {} are people: they drive one after the other", group.name), options.file,
                     "ask who is next with: septet experiment next");
  const auto held = HeldFolder::hold(*study);
  if (!held) return tl::unexpected(held.error());
  program::catch_stop_signals();
  Run run(*study, options);
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

Expected<int> run_experiment_next(const ExperimentOptions& options) {
  const auto study = read_study(options);
  if (!study) return tl::unexpected(study.error());
  const PlannedSubject* next = nullptr;
  Stand stand;
  std::size_t finished = 0;
  std::string missing;
  for (const PlannedSubject& subject : study->plan) {
    const Stand own = stand_of(*study, subject);
    finished += own.is_finished;
    if (own.is_finished)
      for (const auto& questionnaire : missing_answers(*study, own.sessions))
        missing += fmt::format("  {} has not answered {}: septet session answer {} {}\n", subject.participant,
                               questionnaire, own.sessions.back().string(), questionnaire);
    if (own.is_finished || (!options.only.empty() && subject.participant != options.only)) continue;
    if (!next) {
      next = &subject;
      stand = own;
    }
  }
  fmt::print("{} of {} subjects are finished\n", finished, study->plan.size());
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
  fmt::print("  {}\n", command_text(drive_arguments(study->experiment, *next, stand.drive, stand.lap,
                                                    drive.seconds - stand.done_s, folder)));
  return 0;
}

}  // namespace septet::server
