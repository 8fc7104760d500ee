#include "sim-server/command/past_sessions.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <system_error>
#include <utility>

#include "engine/core/printable.hpp"
#include "logging/session_reader.hpp"
#include "sim-server/command/session_command.hpp"

namespace septet::server {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t most_named_answers = 20;

/// A file's name without folder and ending; "unknown" where the session has none of this role.
std::string name_of(const logging::SessionInfo& info, const std::string& role) {
  const auto file = std::ranges::find(info.files, role, &logging::SourceFile::role);
  return file == info.files.end() ? "unknown" : printable(fs::path(file->name).stem().string(), 100);
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
  const double seconds = std::strtod(row("ended_simulated_time_s").c_str(), nullptr);
  if (std::isfinite(seconds)) session.simulated_s = seconds;
  return session;
}

}  // namespace

void PastSessions::look() {
  sessions_.clear();
  folders_.clear();
  std::error_code error;
  if (!fs::is_directory(folder_, error)) return;
  const auto files = find_sessions({folder_});
  if (!files) return;
  std::vector<std::pair<fs::file_time_type, fs::path>> newest;
  for (const fs::path& file : *files) {
    const auto written = fs::last_write_time(file, error);
    if (!error && fs::is_regular_file(file, error)) newest.emplace_back(written, file);
  }
  std::ranges::sort(newest, std::greater<>());
  if (newest.size() > most_listed_sessions) newest.resize(most_listed_sessions);
  std::vector<std::pair<page::PastSession, fs::path>> listed;
  for (const auto& [written, file] : newest) {
    auto [at, is_new] = known_.try_emplace(file);
    Known& known = at->second;
    if (is_new || known.written != written) {
      const std::uint64_t id = is_new ? next_id_++ : known.session.id;
      known = {.written = written};
      if (const auto reader = logging::SessionReader::open(file)) {
        known.is_session = true;
        known.session = session_of(*reader);
      }
      known.session.id = id;
      known.session.folder = printable(file.parent_path().lexically_relative(folder_).string(), 400);
    }
    if (!known.is_session) continue;
    const fs::path folder = file.parent_path();
    known.session.has_report = fs::is_regular_file(folder / "report.html", error);
    known.session.has_debrief = fs::is_regular_file(folder / "debrief.html", error);
    listed.emplace_back(known.session, folder);
  }
  std::ranges::stable_sort(listed, std::greater<>(), [](const auto& one) { return one.first.started_utc; });
  for (auto& [session, folder] : listed) {
    sessions_.push_back(std::move(session));
    folders_.push_back(std::move(folder));
  }
}

}  // namespace septet::server
