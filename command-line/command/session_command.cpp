#include "command-line/command/session_command.hpp"

#include <algorithm>
#include <iostream>
#include <map>
#include <set>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "command-line/command/drive_deletion.hpp"
#include "command-line/command/experiment_study.hpp"
#include "command-line/command/renewed_results.hpp"
#include "engine/core/printable.hpp"
#include "engine/core/regular_file.hpp"
#include "engine/document/json.hpp"
#include "engine/document/text_file.hpp"
#include "logging/session/session_editor.hpp"
#include "logging/session/session_reader.hpp"
#include "logging/study/best_list.hpp"
#include "logging/study/questionnaire.hpp"
#include "program/console.hpp"
#include "program/resources.hpp"
#include "program/run.hpp"

namespace septet::server {
namespace fs = std::filesystem;
namespace {

/// Simulated time until which the driver of a session was observed.
Expected<double> observed_s(const logging::SessionReader& reader) {
  const auto samples = reader.samples();
  if (!samples) return tl::unexpected(samples.error());
  return samples->empty() ? 0.0 : samples->back().simulated_time_s;
}

Expected<logging::Answers> ask(const logging::Questionnaire& questionnaire, std::istream& in, std::ostream& out) {
  logging::Answers answers;
  out << questionnaire.title << '\n';
  for (const auto& item : questionnaire.items) {
    out << '\n' << item.text << '\n';
    for (int value = item.least; !item.labels.empty() && value <= item.most; ++value)
      out << "  " << value << "  " << item.labels[static_cast<std::size_t>(value - item.least)] << '\n';
    for (std::string line;;) {
      out << fmt::format("{} to {}, or nothing: ", item.least, item.most) << std::flush;
      if (!std::getline(in, line) || line.find_first_not_of(" \t\r") == std::string::npos) break;
      const auto answer = logging::read_answer_text(item, line);
      if (answer) {
        answers[item.id] = *answer;
        break;
      }
      out << answer.error().remedy << '\n';
    }
  }
  out << '\n';
  return answers;
}

void leave_person_out(document::Json& summary) {
  summary["participant"] = "";
  if (!summary.contains("subject") || !summary["subject"].is_object()) return;
  summary["subject"].erase("note");
  std::vector<std::string> own;
  for (const auto& item : summary["subject"].items())
    if (item.key().starts_with("column.")) own.push_back(item.key());
  for (const auto& key : own) summary["subject"].erase(key);
}

/// Renames folders named after the participant, as an experiment's are, to a neutral name.
void rename_folders(const std::set<fs::path>& sessions, const std::string& participant) {
  std::error_code ignored;
  for (const fs::path& session : sessions)
    for (fs::path folder = session.parent_path(); folder.has_relative_path(); folder = folder.parent_path()) {
      if (folder.filename() != participant || !fs::exists(folder, ignored)) continue;
      fs::path other;
      for (int number = 1; other.empty() || fs::exists(other, ignored); ++number)
        other = folder.parent_path() / fmt::format("forgotten-{}", number);
      fs::rename(folder, other, ignored);
      program::announce(fmt::format("{}: renamed, for it was called by the participant", other.string()));
    }
}

/// The session comes last: as long as it names the driver, the whole can be repeated.
Expected<void> make_anonymous(const fs::path& session) {
  const auto draft = logging::write_anonymous_copy(session);
  if (!draft) return tl::unexpected(draft.error());
  std::error_code error;
  if (auto renewed = renew_results(session.parent_path(), *draft, leave_person_out); !renewed) {
    fs::remove(*draft, error);
    return renewed;
  }
  fs::rename(*draft, session, error);
  if (error)
    return failure(error.message(), session.string(), "make its folder one that can be written, and do it again");
  return {};
}

LeftOver make_anonymous(const std::vector<fs::path>& sessions) {
  LeftOver result;
  for (const fs::path& session : sessions) {
    auto done = make_anonymous(session);
    if (done)
      result.done.push_back(session);
    else
      result.why.push_back(std::move(done.error()));
  }
  return result;
}

}  // namespace

Expected<std::vector<fs::path>> find_sessions(const std::vector<fs::path>& places) {
  std::vector<fs::path> sessions;
  for (const fs::path& place : places) {
    std::error_code error;
    if (!fs::is_directory(place, error)) {
      sessions.push_back(place);
      continue;
    }
    for (auto it = fs::recursive_directory_iterator(place, fs::directory_options::skip_permission_denied, error);
         !error && it != fs::recursive_directory_iterator(); it.increment(error))
      if (it->path().filename() == "session.sqlite") sessions.push_back(it->path());
    if (error) return failure(error.message(), place.string(), "check the path");
  }
  std::ranges::sort(sessions);
  sessions.erase(std::unique(sessions.begin(), sessions.end()), sessions.end());
  return sessions;
}

Expected<int> run_session_answer(const AnswerOptions& options, std::istream& in, std::ostream& out) {
  const auto file = program::find_resource(options.questionnaire, "scenarios/questionnaires", ".toml");
  if (!file) return tl::unexpected(file.error());
  const auto text = read_regular_file(*file);
  if (!text) return tl::unexpected(text.error());
  const auto questionnaire = logging::read_questionnaire(*text, file->string());
  if (!questionnaire) return tl::unexpected(questionnaire.error());
  const auto seen_s = logging::SessionReader::open(options.session).and_then(observed_s);
  if (!seen_s) return tl::unexpected(seen_s.error());
  Expected<logging::Answers> answers;
  if (options.answers.empty()) {
    answers = ask(*questionnaire, in, out);
  } else {
    const auto given = read_regular_file(options.answers);
    if (!given) return tl::unexpected(given.error());
    answers = logging::read_answers(*questionnaire, *given, options.answers.string());
  }
  if (!answers) return tl::unexpected(answers.error());
  const std::string prefix = options.as.empty() ? questionnaire->id : options.as;
  if (!printable_characters(prefix) || prefix.size() > 60 || prefix.find('.') != std::string::npos)
    return failure(fmt::format("\"{}\" is no name for its answers", printable(prefix, 60)), "--as",
                   "use a word without a point");
  const auto added = logging::add_answers(options.session,
                                          logging::records_of(*questionnaire, *answers, prefix, *seen_s), prefix + '.');
  if (!added) return tl::unexpected(added.error());
  if (auto renewed = renew_results(options.session.parent_path(), options.session); !renewed)
    return tl::unexpected(renewed.error());
  for (const auto& [id, score] : logging::scores_of(*questionnaire, *answers))
    out << fmt::format("{}.{}: {}\n", prefix, id,
                       score ? fmt::format("{:.2f}", *score) : "no score, an answer is missing");
  out << fmt::format("{} of {} items answered\n", answers->size(), questionnaire->items.size());
  return 0;
}

Expected<int> run_session_stop(const StopOptions& options) {
  if (!printable_characters(options.reason))
    return failure("the reason cannot be printed on one line", "--reason", "leave control characters away");
  const auto seen_s = logging::SessionReader::open(options.session).and_then(observed_s);
  if (!seen_s) return tl::unexpected(seen_s.error());
  if (options.at_s && *options.at_s > *seen_s)
    return failure(fmt::format("the session ends after {:.1f} s", *seen_s), "--at", "give a time within it");
  const double at_s = options.at_s.value_or(*seen_s);
  const auto added =
      logging::add_answers(options.session, {logging::drop_out(at_s, options.reason)}, "drive_completed");
  if (!added) return tl::unexpected(added.error());
  if (auto renewed = renew_results(options.session.parent_path(), options.session); !renewed)
    return tl::unexpected(renewed.error());
  program::announce(fmt::format("{}: dropped out after {:.1f} s", options.session.string(), at_s));
  return 0;
}

Expected<int> run_session_forget(const ForgetOptions& options) {
  if (options.participant.empty())
    return failure("it names nobody", "the participant's code", "give the code that their drives were recorded with");
  auto found = find_sessions(options.places);
  if (!found) return tl::unexpected(found.error());
  const Links links = links_in(options.places);
  // A folder that is a link is not looked through, so that no folder is counted twice: what lies behind it is told.
  for (const auto& [link, target] : links)
    if (std::error_code error; fs::is_directory(target, error) && !lies_in(target, options.places))
      if (const auto behind = find_sessions({target})) found->insert(found->end(), behind->begin(), behind->end());
  std::map<fs::path, std::set<fs::path>> theirs;  // Each with the names under which it was found.
  std::set<fs::path> outside;
  std::vector<Error> unread;  // Perhaps the participant's; the others are processed anyway.
  for (const fs::path& session : *found) {
    auto reader = logging::SessionReader::open(session);
    if (!reader) {
      unread.push_back(std::move(reader.error()));
      continue;
    }
    if (reader->info().participant != options.participant) continue;
    const fs::path held = holder_of(session);
    std::error_code error;
    const fs::path whole = fs::canonical(held, error);
    if (lies_in(whole, options.places))
      theirs[held].insert({held, session});
    else
      outside.insert(whole);
  }
  const auto name_left = [&] {
    for (const Error& why : unread) program::say("septet: a session's participant could not be read: " + describe(why));
    for (const fs::path& session : outside)
      program::say("septet: not done: " +
                   describe({"a link leads to this session, which lies in none of the places given", session.string(),
                             fmt::format("give {} too", session.parent_path().string())}));
  };
  if (theirs.empty()) {
    name_left();
    if (!outside.empty()) return program::failed_status;
    return failure(fmt::format("none of {} sessions {}is of {}", found->size() - unread.size(),
                               unread.empty() ? "" : "that can be read ", printable(options.participant, 60)),
                   options.places.front().string(), "check the code and the folders");
  }
  // First of all: after a kill from here on, the experiment still does not drive them again.
  std::set<fs::path> experiments;
  for (const auto& [held, names] : theirs)
    for (const fs::path& session : names)
      if (auto experiment = experiment_of(session, options.participant)) experiments.insert(std::move(*experiment));
  for (const fs::path& experiment : experiments)
    if (auto noted = note_forgotten(experiment, options.participant); !noted) return tl::unexpected(noted.error());
  std::vector<fs::path> sessions;
  sessions.reserve(theirs.size());
  for (const auto& [held, names] : theirs) sessions.push_back(held);
  const LeftOver result = options.delete_data ? delete_drives(sessions) : make_anonymous(sessions);
  std::vector<Error> failed = result.why;
  if (options.delete_data)
    for (Error& left : remove_links_to_nothing(links)) failed.push_back(std::move(left));
  std::set<fs::path> lists, done;
  for (const fs::path& session : result.done) done.insert(theirs[session].begin(), theirs[session].end());
  for (const fs::path& session : done)
    lists.insert(fs::absolute(session).parent_path().parent_path() / "best-list.json");
  for (const fs::path& list : lists)
    if (auto gone = logging::forget_in_best_list(list, options.participant); !gone)
      failed.push_back(std::move(gone.error()));
  rename_folders(done, options.participant);
  program::announce(fmt::format("{} of {} sessions {}; make pooled reports and tables anew", result.done.size(),
                                found->size(),
                                options.delete_data ? "deleted" : "no longer name the driver; their data are kept"));
  name_left();
  for (const Error& why : failed) program::say("septet: not done: " + describe(why));
  if (!unread.empty() || !outside.empty() || !failed.empty()) return program::failed_status;
  return 0;
}

}  // namespace septet::server
