#include "command-line/command/past_sessions.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "command-line/command/session_command.hpp"
#include "engine/core/printable.hpp"
#include "engine/document/table_line.hpp"
#include "logging/session/outcome.hpp"
#include "logging/session/session_reader.hpp"
#include "logging/study/lesson/lesson.hpp"
#include "sim-server/page/signals_away.hpp"

namespace septet::server {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t most_named_answers = 20, most_tasks = 40;

/// A file's name without folder and ending; "unknown" if the session has none of this role.
std::string name_of(const logging::SessionInfo& info, const std::string& role) {
  const auto file = std::ranges::find(info.files, role, &logging::SourceFile::role);
  return file == info.files.end() ? "unknown" : printable(fs::path(file->name).stem().string(), 100);
}

/// Number behind ` KEY=` in an event's text; empty if there is none.
std::optional<double> number_in(std::string_view detail, std::string_view key) {
  const auto at = detail.find(key);
  if (at == detail.npos) return std::nullopt;
  const std::string_view rest = detail.substr(at + key.size());
  return document::number_in<double>(rest.substr(0, rest.find(' ')));
}

/// Marks of a lesson, by the rules kept in the session, and points of a game. A session whose records cannot be read
/// has neither.
void add_marks(page::PastSession& session, const logging::SessionReader& reader) {
  const auto events = reader.events();
  if (!events) return;
  for (const logging::Event& event : *events)
    if (event.kind == "game") {
      if (const auto points = number_in(event.detail, " points=")) session.points = points;
      if (const auto level = number_in(event.detail, "level="); level && *level >= 0.0 && *level < 1e6)
        session.level = static_cast<int>(*level);
    }
  const auto& files = reader.info().files;
  const auto source = std::ranges::find(files, logging::lesson_role, &logging::SourceFile::role);
  if (source == files.end()) return;
  const auto lesson = logging::read_lesson(source->content, source->name);
  const auto samples = reader.samples();
  if (!lesson || !samples) return;
  const logging::LessonMarks marks = logging::mark_lesson(*lesson, *samples, *events);
  session.lesson = printable(lesson->title, 200);
  session.mark = marks.mark;
  session.is_taken = marks.taken;
  session.is_passed = marks.passed;
  for (std::size_t i = 0; i < marks.tasks.size() && i < most_tasks; ++i)
    session.tasks.push_back({printable(lesson->tasks[i].says, 200), marks.tasks[i].mark,
                             std::string(logging::name_of(marks.tasks[i].severity))});
}

page::PastSession session_of(const logging::SessionReader& reader) {
  const logging::SessionInfo& info = reader.info();
  const auto row = [&](const char* key) {
    const auto found = info.other.find(key);
    return found == info.other.end() ? std::string() : found->second;
  };
  page::PastSession session{.started_utc = printable(info.started_utc, 40),
                            .scenario = name_of(info, "scenario"),
                            .rig = name_of(info, "rig"),
                            .driver = printable(row("driver"), 60),
                            .participant = printable(info.participant, 400),
                            .ended = printable(row("ended_why"), 40)};
  if (!reader.ended_cleanly()) session.ended = "killed";
  if (const auto rows = reader.questionnaire())
    for (const auto& answer : *rows) {
      const std::string name = printable(answer.item.substr(0, answer.item.find('.')), 60);
      if (answer.value && std::ranges::find(session.answered, name) == session.answered.end() &&
          session.answered.size() < most_named_answers)
        session.answered.push_back(name);
    }
  session.note = printable(row("note"), 500);
  add_marks(session, reader);
  // A session without snapshots knows it by its outcome alone.
  const auto outcome = logging::read_outcome(row("outcome"), reader.path().string());
  const double seconds = outcome ? outcome->simulated_s : std::strtod(row("ended_simulated_time_s").c_str(), nullptr);
  if (std::isfinite(seconds)) session.simulated_s = seconds;
  return session;
}

}  // namespace

PastSessions::PastSessions(fs::path folder) : folder_(std::move(folder)) {
  const page::SignalsAway away;
  thread_ = std::thread([this] { run(); });
}

PastSessions::~PastSessions() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  wanted_.notify_all();
  thread_.join();
}

void PastSessions::look() {
  {
    const std::lock_guard lock(mutex_);
    is_wanted_ = found_.is_looking = true;
  }
  wanted_.notify_all();
}

bool PastSessions::has_news() {
  const std::lock_guard lock(mutex_);
  return std::exchange(has_news_, false);
}

FoundSessions PastSessions::found() const {
  const std::lock_guard lock(mutex_);
  return found_;
}

void PastSessions::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    wanted_.wait(lock, [this] { return is_wanted_ || is_over_; });
    if (is_over_) return;
    is_wanted_ = false;
    lock.unlock();
    look_once();
    lock.lock();
    has_news_ = true;
    found_.is_looking = is_wanted_;
  }
}

void PastSessions::look_once() {
  std::error_code error;
  std::vector<std::pair<fs::file_time_type, fs::path>> newest;
  const bool is_there = fs::is_directory(folder_, error);
  if (const auto files = is_there ? find_sessions({folder_}) : Expected<std::vector<fs::path>>())
    for (const fs::path& file : *files) {
      const auto written = fs::last_write_time(file, error);
      if (!error && fs::is_regular_file(file, error)) newest.emplace_back(written, file);
    }
  std::ranges::sort(newest, std::greater<>());
  if (newest.size() > most_listed_sessions) newest.resize(most_listed_sessions);
  // A listed session stays until it has been read again: a row that vanishes for a moment would slip from under a
  // pointer.
  const auto list = [&] {
    std::vector<std::pair<const page::PastSession*, fs::path>> listed;
    for (const auto& [written, file] : newest)
      if (const auto at = known_.find(file); at != known_.end() && at->second.is_session)
        listed.emplace_back(&at->second.session, file.parent_path());
    std::ranges::stable_sort(listed, std::greater<>(), [](const auto& one) { return one.first->started_utc; });
    FoundSessions found{.sessions = {}, .folders = {}, .is_looking = true};
    for (auto& [session, folder] : listed) {
      found.sessions.push_back(*session);
      found.folders.push_back(std::move(folder));
    }
    const std::lock_guard lock(mutex_);
    found_ = std::move(found);
    has_news_ = true;
    return !is_over_;
  };
  const auto look_beside = [&](page::PastSession& session, const fs::path& file) {
    session.has_report = fs::is_regular_file(file.parent_path() / "report.html", error);
    session.has_debrief = fs::is_regular_file(file.parent_path() / "debrief.html", error);
    session.has_film = fs::is_regular_file(file.parent_path() / "film.mp4", error);
  };
  // Known sessions appear at once; the others are read one after the other, the newest first.
  std::vector<std::pair<fs::file_time_type, fs::path>> unread;
  for (const auto& [written, file] : newest) {
    const auto at = known_.find(file);
    if (at != known_.end()) look_beside(at->second.session, file);
    if (at == known_.end() || at->second.written != written) unread.emplace_back(written, file);
  }
  if (!list()) return;
  for (const auto& [written, file] : unread) {
    Known read{.written = written, .is_session = false, .session = {}};
    if (const auto reader = logging::SessionReader::open(file)) {
      read.is_session = true;
      read.session = session_of(*reader);
    }
    const auto [at, is_new] = known_.try_emplace(file);
    read.session.id = is_new ? next_id_++ : at->second.session.id;
    read.session.folder = printable(file.parent_path().lexically_relative(folder_).string(), 400);
    look_beside(read.session, file);
    at->second = std::move(read);
    if (!list()) return;
  }
}

}  // namespace septet::server
