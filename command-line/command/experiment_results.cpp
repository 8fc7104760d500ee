#include "command-line/command/experiment_results.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "engine/core/regular_file.hpp"
#include "engine/core/version.hpp"
#include "engine/document/json.hpp"
#include "engine/document/text_file.hpp"
#include "logging/session/session_editor.hpp"
#include "logging/session/session_reader.hpp"
#include "logging/study/questionnaire.hpp"
#include "logging/study/report/group_report.hpp"

namespace septet::server {
namespace fs = std::filesystem;
using document::Json;
using logging::PlannedDrive, logging::PlannedSubject;

namespace {

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
        const auto arguments = drive_arguments(study.experiment, subject, i, lap, drive.seconds - done_s,
                                               fs::relative(folder, study.folder));
        const auto summary = read_regular_file(folder / "summary.json");
        const auto parsed = Json::parse(summary.value_or(""), nullptr, false);
        json["drives"].push_back({{"participant", subject.participant},
                                  {"group", study.experiment.groups[subject.group].name},
                                  {"drive", drive_name(study.experiment, drive, lap)},
                                  {"seed", drive_seed(study.experiment, subject.number, drive, lap)},
                                  {"simulated_s", found.simulated_s},
                                  {"state_hash", parsed.is_object() ? parsed.value("state_hash", "") : ""},
                                  {"command", command_text("septet drive --no-screens", arguments)}});
        done_s += found.simulated_s;
      }
    }
  }
  return document::text_of(json);
}

/// Text above the figures.
std::string note_of(const std::string& note, std::size_t forgotten, std::size_t subjects) {
  if (forgotten == 0) return note;
  return fmt::format("{}{}{} of {} subjects {} forgotten, and {} in no figure here.", note, note.empty() ? "" : " ",
                     forgotten, subjects, forgotten > 1 ? "were" : "was", forgotten > 1 ? "are" : "is");
}

}  // namespace

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

Expected<void> write_study(const Study& study) {
  std::vector<fs::path> sessions;
  std::size_t forgotten = 0;
  for (const PlannedSubject& subject : study.plan) {
    // A run that was killed at that moment has not noted it; an existing note stays.
    if (auto noted = note_playing_time(study, subject); !noted) return noted;
    const Stand stand = stand_of(study, subject);
    forgotten += stand.is_forgotten;
    sessions.insert(sessions.end(), stand.sessions.begin(), stand.sessions.end());
  }
  auto subjects = logging::pool_sessions(sessions, {});
  if (!subjects) return tl::unexpected(subjects.error());
  const auto written = document::write_text_file(study.folder / "experiment.json", experiment_json(study));
  if (!written) return written;
  return logging::write_group_report({.title = study.experiment.title,
                                      .note = note_of(study.experiment.note, forgotten, study.plan.size()),
                                      .subjects = std::move(*subjects),
                                      .settings = {}},
                                     study.folder);
}

}  // namespace septet::server
