#include "command-line/command/experiment_study.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "command-line/command/experiment_change.hpp"
#include "engine/core/printable.hpp"
#include "engine/core/regular_file.hpp"
#include "engine/core/version.hpp"
#include "engine/document/json.hpp"
#include "engine/document/text_file.hpp"
#include "logging/session/session_reader.hpp"
#include "program/resources.hpp"

namespace septet::server {
namespace fs = std::filesystem;
using logging::Experiment, logging::PlannedDrive, logging::PlannedSubject;

namespace {

fs::path list_of_forgotten(const fs::path& experiment) { return experiment / "forgotten.txt"; }

bool is_forgotten(const fs::path& experiment, const std::string& participant) {
  const auto list = read_regular_file(list_of_forgotten(experiment));
  return list && ('\n' + *list).find('\n' + participant + '\n') != std::string::npos;
}

}  // namespace

Expected<Study> read_study(const ExperimentOptions& options) {
  const auto file = program::find_resource(options.file, "scenarios/experiments", ".toml");
  if (!file) return tl::unexpected(file.error());
  auto text = read_regular_file(*file);
  if (!text) return tl::unexpected(text.error());
  auto experiment = logging::read_experiment(*text, file->string());
  if (!experiment) return tl::unexpected(experiment.error());
  Study study{std::move(*experiment), std::move(*text), file->stem().string(), {}, options.out, {}};
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
  auto questionnaires = read_inputs(study.experiment);
  if (!questionnaires) return tl::unexpected(questionnaires.error());
  study.questionnaires = std::move(*questionnaires);
  return study;
}

fs::path drive_folder(const Study& study, const PlannedSubject& subject, const PlannedDrive& drive, std::size_t lap) {
  return study.folder / "subjects" / subject.participant / drive_name(study.experiment, drive, lap);
}

FoundDrive find_drive(const fs::path& folder) {
  FoundDrive found;
  std::error_code ignored;
  found.is_begun = fs::exists(folder / "session.sqlite", ignored);
  const auto summary = read_regular_file(folder / "summary.json");
  if (!found.is_begun || !summary) return found;
  const auto json = document::Json::parse(*summary, nullptr, false);
  if (!json.is_object() || json.value("exit_status", -1) != 0 || !json.contains("distance_m")) return found;
  // The summary is written after the session is closed. A side file may stay beside it while a reader has it open.
  const auto reader = logging::SessionReader::open(folder / "session.sqlite");
  if (!reader || !reader->ended_cleanly()) return found;
  found.simulated_s = json.value("simulated_s", 0.0);
  found.is_whole = found.simulated_s > 0.0;
  return found;
}

Stand stand_of(const Study& study, const PlannedSubject& subject) {
  Stand stand;
  if (is_forgotten(study.folder, subject.participant)) {
    stand.is_finished = stand.is_forgotten = true;
    return stand;
  }
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
      stand.drive_of_session.push_back(stand.drive);
    }
  }
  stand.is_finished = true;
  return stand;
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
  for (const auto& parameter : parameters_of(part, condition)) add({"--parameter=" + parameter});
  add({"--out", folder.string()});
  return arguments;
}

std::string command_text(std::string command, const std::vector<std::string>& arguments) {
  for (const auto& argument : arguments)
    command += argument.find(' ') == std::string::npos ? ' ' + argument : " '" + argument + '\'';
  return command;
}

Expected<std::unique_ptr<HeldFolder>> HeldFolder::hold(const fs::path& folder) {
  auto held = std::make_unique<HeldFolder>();
  held->file_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (held->file_ >= 0 && ::flock(held->file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    return failure("this experiment is being run already", folder.string(),
                   "wait for its end, or choose another folder with --out");
  return held;
}

Expected<std::unique_ptr<HeldFolder>> HeldFolder::hold(const Study& study) {
  std::error_code error;
  fs::create_directories(study.folder / "subjects", error);
  if (error) return failure(error.message(), study.folder.string(), "choose a folder that can be written with --out");
  auto held = hold(study.folder);
  if (!held) return held;
  const fs::path own = study.folder / "experiment.toml";
  if (fs::exists(own, error)) {
    const auto earlier = read_regular_file(own);
    if (!earlier) return tl::unexpected(earlier.error());
    if (*earlier != study.text)
      if (auto same = check_same_drives(study, *earlier); !same) return tl::unexpected(same.error());
    const auto by = read_regular_file(study.folder / "version.txt");
    if (by && *by != version_text() + '\n')
      return failure(fmt::format("it was begun with Septet {}, and this is {}",
                                 printable(by->substr(0, by->find('\n'))), version_text()),
                     study.folder.string(), "go on with that one, or begin anew with --out");
    if (*earlier == study.text) return held;
    fs::path aside;
    for (int number = 1; aside.empty() || fs::exists(aside, error); ++number)
      aside = study.folder / fmt::format("experiment.{}.toml", number);
    if (auto kept = document::write_text_file(aside, *earlier); !kept) return tl::unexpected(kept.error());
    if (auto written = document::write_text_file(own, study.text); !written) return tl::unexpected(written.error());
    return held;
  }
  const auto written = document::write_text_files(
      study.folder, {{"version.txt", version_text() + '\n'}, {"experiment.toml", study.text}});
  if (!written) return tl::unexpected(written.error());
  return held;
}

HeldFolder::~HeldFolder() {
  if (file_ >= 0) ::close(file_);
}

std::optional<fs::path> experiment_of(const fs::path& session, const std::string& participant) {
  std::error_code error;
  const fs::path subject = fs::absolute(session, error).lexically_normal().parent_path().parent_path();
  const fs::path subjects = subject.parent_path();
  if (error || subject.filename() != participant || subjects.filename() != "subjects") return std::nullopt;
  const fs::path experiment = subjects.parent_path();
  return fs::exists(experiment / "experiment.toml", error) ? std::optional(experiment) : std::nullopt;
}

Expected<void> note_forgotten(const fs::path& experiment, const std::string& participant) {
  const auto held = HeldFolder::hold(experiment);
  if (!held) return tl::unexpected(held.error());
  if (is_forgotten(experiment, participant)) return {};
  const fs::path list = list_of_forgotten(experiment);
  std::string text;
  if (std::error_code error; fs::exists(list, error)) {
    auto earlier = read_regular_file(list);
    if (!earlier) return tl::unexpected(earlier.error());
    text = std::move(*earlier);
  }
  return document::write_text_file(list, text + participant + '\n');
}

}  // namespace septet::server
