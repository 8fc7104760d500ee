#include "command-line/command/past_work.hpp"

#include <chrono>
#include <csignal>
#include <system_error>
#include <utility>

#include "command-line/command/last_line.hpp"

namespace septet::server {
namespace fs = std::filesystem;

Expected<void> PastWork::start(const page::Make& make, const fs::path& folder, const fs::path& log) {
  if (process_)
    return failure("a film or a replay goes on already", "past drives", "wait until it is over, or stop it");
  const std::string session = (folder / "session.sqlite").string();
  const bool is_film = make.what == "film";
  program::ChildOptions child{
      .program = (program::own_folder() / "septet").string(), .arguments = {}, .environment = {}, .log = log};
  if (is_film) {
    // An earlier film is replaced.
    std::error_code ignored;
    fs::remove(folder / "film.mp4", ignored);
    child.arguments = {"film", session, "--fps", "30", "--out", (folder / "film.mp4").string()};
  } else {
    child.arguments = {"replay", session};
  }
  auto process = program::ChildProcess::start(child);
  if (!process) return tl::unexpected(process.error());
  process_.emplace(std::move(*process));
  log_ = log;
  is_stopped_ = false;
  view_ = page::PastWorkView{
      .session = make.session, .what = make.what, .is_running = true, .has_failed = false, .said = ""};
  return {};
}

bool PastWork::attend() {
  if (!process_) return false;
  using namespace std::chrono_literals;
  while (process_->read_line(0ms)) {
  }
  const auto exit = process_->poll();
  const page::PastWorkView before = *view_;
  view_->said = last_line_of(log_);
  if (exit) {
    view_->is_running = false;
    view_->has_failed = exit->code != 0 && !is_stopped_;
    process_.reset();
    std::error_code ignored;
    fs::remove(log_, ignored);
  }
  return before != *view_;
}

bool PastWork::stop() {
  if (!process_) return false;
  is_stopped_ = true;
  process_->send_signal(SIGTERM);
  return true;
}

}  // namespace septet::server
