#include "command-line/command/operate_command.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <ctime>
#include <fstream>
#include <memory>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include <unistd.h>

#include <fmt/format.h>

#include "command-line/command/chosen_command.hpp"
#include "command-line/command/experiment_next.hpp"
#include "command-line/command/operate_choices.hpp"
#include "command-line/command/past_sessions.hpp"
#include "command-line/command/past_work.hpp"
#include "command-line/command/questionnaire_answers.hpp"
#include "engine/core/printable.hpp"
#include "logging/session/drive_end.hpp"
#include "program/child_process.hpp"
#include "program/console.hpp"
#include "program/resources.hpp"
#include "program/stop_signal.hpp"
#include "program/temporary_folder.hpp"
#include "sim-server/page/request_checks.hpp"
#include "sim-server/page/start_page.hpp"

namespace septet::server {
namespace fs = std::filesystem;
namespace {

using namespace std::chrono_literals;

constexpr auto look_every = 20ms, show_found_every = 250ms;
constexpr std::size_t shown_lines = 8;

/// The newest output lines of a drive, made printable.
std::vector<std::string> lines_of(const fs::path& log) {
  std::vector<std::string> lines;
  std::ifstream in(log);
  for (std::string line; std::getline(in, line);) {
    // Hints for a typing person are skipped.
    if (line.find_first_not_of(" \r\t") == std::string::npos || line.starts_with("Run with --help")) continue;
    lines.push_back(printable(line));
    if (lines.size() > shown_lines) lines.erase(lines.begin());
  }
  return lines;
}

/// A drive that was started: `septet drive` from its start to its end.
struct RunningDrive {
  program::ChildProcess process;
  fs::path log;
  std::string command, last_line;
  bool is_cancelled = false;

  /// Reads its standard output; the last line holds the reason of its end.
  void listen() {
    while (auto line = process.read_line(0ms))
      if (!line->empty()) last_line = printable(*line);
  }
  /// True once the drive serves the page itself.
  bool has_page() const {
    std::ifstream in(log);
    for (std::string line; std::getline(in, line);)
      if (line.find("operator's page: ") != std::string::npos) return true;
    return false;
  }
};

/// Name of a new folder below `out`: time and choice.
fs::path new_folder(const fs::path& out, const std::string& name) {
  const std::string scenario = fs::path(name).stem().string();  // A user's scenario is a file.
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  char when[32];
  std::strftime(when, sizeof when, "%Y-%m-%dT%H-%M-%SZ", &parts);
  std::error_code ignored;
  fs::path folder = out / fmt::format("{}-{}", when, scenario);
  for (int number = 2; fs::exists(folder, ignored); ++number)
    folder = out / fmt::format("{}-{}-{}", when, scenario, number);
  return folder;
}

/// The page with its data, and the running drive, if there is one.
class Operation {
 public:
  Operation(OperateOptions options, page::ListeningSocket listening, page::Choices choices,
            std::vector<logging::Questionnaire> questionnaires, program::TemporaryFolder logs)
      : options_(std::move(options)),
        listening_(std::move(listening)),
        choices_(std::move(choices)),
        questionnaires_(std::move(questionnaires)),
        logs_(std::move(logs)),
        past_(options_.out) {}

  std::string url() const { return fmt::format("http://127.0.0.1:{}/#{}", listening_.port(), token_); }
  /// Until a signal comes.
  Expected<void> run();

 private:
  Expected<void> open_page();
  void show();
  void obey(const page::OperatorWish& wish);
  std::optional<std::string> take_answers(const page::Answer& answer);
  std::optional<std::string> make(const page::Make& wish);
  std::optional<std::filesystem::path> folder_of(std::uint64_t session) const;
  Expected<void> start(const page::DriveChoice& choice);
  void attend_drive();
  void attend_past();
  void end_drive(const program::ChildExit& exit);

  OperateOptions options_;
  page::ListeningSocket listening_;
  page::Choices choices_;
  std::vector<logging::Questionnaire> questionnaires_;
  program::TemporaryFolder logs_;
  std::string token_ = page::random_token();
  PastSessions past_;
  FoundSessions found_;  ///< As shown on the page.
  std::chrono::steady_clock::time_point shown_at_{};
  page::StartView view_;
  std::unique_ptr<page::StartPage> page_;  ///< Null while a drive serves it.
  std::optional<RunningDrive> drive_;
  PastWork work_;
  int drives_ = 0;
};

Expected<void> Operation::open_page() {
  auto page = page::StartPage::open(listening_, token_, options_.page_hosts, choices_);
  if (!page) return tl::unexpected(page.error());
  page_ = std::move(*page);
  past_.look();
  show();
  return {};
}

void Operation::show() {
  if (!page_) return;
  found_ = past_.found();
  view_.sessions = found_.sessions;
  view_.is_looking = found_.is_looking;
  view_.work = work_.view();
  page_->show(view_, found_.folders);
}

/// Sessions appear as they are found, a few times a second.
void Operation::attend_past() {
  const bool was_making = work_.is_running();
  if (work_.attend()) {
    if (was_making && !work_.is_running()) past_.look();
    show();
  }
  const auto now = std::chrono::steady_clock::now();
  if (!page_ || now - shown_at_ < show_found_every || !past_.has_news()) return;
  shown_at_ = now;
  show();
}

Expected<void> Operation::start(const page::DriveChoice& choice) {
  std::vector<std::string> command;
  if (choice.experiment.empty()) {
    command = command_of(choice, options_, new_folder(options_.out, choice.scenario));
  } else {
    const fs::path folder = options_.out / fs::path(choice.experiment).stem();
    auto next = next_of_experiment({.file = choice.experiment, .out = folder, .only = choice.participant});
    if (!next) return tl::unexpected(next.error());
    command = command_of_experiment(*next, choice, options_);
  }
  auto handed = listening_.copy(true);
  if (!handed) return tl::unexpected(handed.error());
  program::ChildOptions child;
  child.program = (program::own_folder() / command.front()).string();
  child.arguments = {command.begin() + 1, command.end()};
  child.environment[page::handover_variable] = page::text_of({*handed, token_});
  child.log = logs_.path() / fmt::format("drive-{}.log", ++drives_);
  auto process = program::ChildProcess::start(child);
  handed->close();
  if (!process) return tl::unexpected(process.error());
  drive_.emplace(RunningDrive{std::move(*process), child.log, typed(command), ""});
  program::say("started: " + drive_->command);
  view_ = {.is_starting = true, .command = drive_->command};
  return {};
}

void Operation::obey(const page::OperatorWish& wish) {
  std::optional<std::string> why_not;
  if (const auto* begin = std::get_if<page::Start>(&wish.wish)) {
    why_not = drive_ ? "a drive is being started already" : no_choice(choices_, begin->choice);
    if (!why_not)
      if (const auto started = start(begin->choice); !started) why_not = describe(started.error());
  } else if (const auto* answer = std::get_if<page::Answer>(&wish.wish)) {
    why_not = take_answers(*answer);
  } else if (const auto* wished = std::get_if<page::Make>(&wish.wish)) {
    why_not = make(*wished);
  } else if (std::holds_alternative<page::StopMaking>(wish.wish)) {
    if (!work_.stop()) why_not = "nothing is being made";
  } else if (drive_) {  // Cancel.
    drive_->is_cancelled = true;
    drive_->process.send_signal(SIGTERM);
  } else {
    why_not = "nothing is being started";
  }
  page_->answer(wish, why_not);
  show();
}

std::optional<std::string> Operation::take_answers(const page::Answer& answer) {
  const auto folder = folder_of(answer.session);
  if (!folder) return "there is no such session any more";
  if (auto why_not = keep_answers(questionnaires_, answer, *folder / "session.sqlite")) return why_not;
  past_.look();
  return std::nullopt;
}

std::optional<fs::path> Operation::folder_of(std::uint64_t session) const {
  const auto found = std::ranges::find(found_.sessions, session, &page::PastSession::id);
  if (found == found_.sessions.end()) return std::nullopt;
  return found_.folders[static_cast<std::size_t>(found - found_.sessions.begin())];
}

std::optional<std::string> Operation::make(const page::Make& wish) {
  if (wish.what != "film" && wish.what != "replay") return "only a film or a replay can be made";
  const auto folder = folder_of(wish.session);
  if (!folder) return "there is no such session any more";
  const auto started = work_.start(wish, *folder, logs_.path() / fmt::format("work-{}.log", ++drives_));
  return started ? std::nullopt : std::optional(describe(started.error()));
}

void Operation::attend_drive() {
  drive_->listen();
  if (const auto exit = drive_->process.poll()) return end_drive(*exit);
  if (!page_) return;
  if (drive_->has_page()) return page_.reset();
  auto lines = lines_of(drive_->log);
  if (lines == view_.said) return;
  view_.said = std::move(lines);
  show();
}

void Operation::end_drive(const program::ChildExit& exit) {
  drive_->listen();
  view_ = {.command = drive_->command, .said = lines_of(drive_->log), .last = drive_->last_line};
  view_.has_failed = exit.code != logging::finished_status && exit.code != logging::stopped_status;
  if (view_.last.empty() && !view_.said.empty()) view_.last = view_.said.back();
  if (drive_->is_cancelled) view_.last = "the start was called off";
  if (exit.signal != 0) view_.last = fmt::format("the drive was ended by signal {}", exit.signal);
  program::say("ended: " + view_.last);
  std::error_code ignored;
  fs::remove(drive_->log, ignored);
  drive_.reset();
  past_.look();
  show();
}

Expected<void> Operation::run() {
  bool has_forwarded = false;
  while (true) {
    if (const auto signal = program::stop_signal()) {
      program::obey_stop_signal();
      if (!drive_) return {};
      if (!std::exchange(has_forwarded, true)) drive_->process.send_signal(*signal);
    }
    if (drive_) attend_drive();
    if (!page_ && !drive_)
      if (auto opened = open_page(); !opened) return opened;
    if (page_)
      for (const auto& wish : page_->take_wishes()) obey(wish);
    attend_past();
    std::this_thread::sleep_for(look_every);
  }
}

}  // namespace

Expected<int> run_operate(OperateOptions options) {
  auto choices = find_choices(options);
  if (!choices) return tl::unexpected(choices.error());
  auto questionnaires = find_questionnaires();
  if (!questionnaires) return tl::unexpected(questionnaires.error());
  choices->questionnaires = choices_of(*questionnaires);
  if (options.out.empty()) {
    const auto data = program::data_folder();
    if (!data) return tl::unexpected(data.error());
    options.out = *data / "out" / "drives";
  }
  std::error_code error;
  fs::create_directories(options.out, error);
  if (error) return failure(error.message(), options.out.string(), "choose a folder that can be written with --out");
  options.out = fs::absolute(options.out, error).lexically_normal();
  auto listening = page::ListeningSocket::open(options.port);
  if (!listening) return tl::unexpected(listening.error());
  options.port = listening->port();
  auto logs = program::TemporaryFolder::make("septet");
  if (!logs) return tl::unexpected(logs.error());
  program::catch_stop_signals();
  Operation operation(std::move(options), std::move(*listening), std::move(*choices), std::move(*questionnaires),
                      std::move(*logs));
  program::announce("operator's page: " + operation.url());
  return operation.run().map([] { return logging::finished_status; });
}

}  // namespace septet::server
