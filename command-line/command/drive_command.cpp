#include "command-line/command/drive_command.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <unistd.h>

#include "command-line/command/chosen_command.hpp"
#include "command-line/command/drive_folder.hpp"
#include "command-line/command/last_line.hpp"
#include "command-line/command/panorama_file.hpp"
#include "command-line/command/town_scenario.hpp"
#include "engine/core/regular_file.hpp"
#include "engine/document/text_file.hpp"
#include "engine/editor/edit_place.hpp"
#include "engine/net/keys.hpp"
#include "engine/rig/rig.hpp"
#include "logging/session/drive_end.hpp"
#include "logging/session/session_reader.hpp"
#include "logging/study/report/report.hpp"
#include "program/child_process.hpp"
#include "program/console.hpp"
#include "program/resources.hpp"
#include "program/stop_signal.hpp"
#include "program/temporary_folder.hpp"
#include "sim-server/host/rig_keys.hpp"
#include "sim-server/page/listening_socket.hpp"
#include "sim-server/page/request_checks.hpp"

namespace septet::server {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

/// An empty name is no display, as for X itself: services and cron set it so.
bool has_display() {
  const auto names_one = [](const char* variable) {
    const char* name = std::getenv(variable);
    return name && *name != '\0';
  };
  return names_one("DISPLAY") || names_one("WAYLAND_DISPLAY");
}

constexpr const char* editor_name = "editor";

/// The line of the list of the editor, whose key lies in that folder beside the server's.
Expected<std::string> admit_editor(const fs::path& folder, const net::PublicKey& server) {
  const auto identity = net::load_or_create_identity(folder / fmt::format("{}.key", editor_name));
  if (!identity) return tl::unexpected(identity.error());
  if (auto put = document::write_text_file(folder / "server.public", net::to_text(server) + '\n'); !put)
    return tl::unexpected(put.error());
  return fmt::format("{} {} edit operate\n", net::to_text(identity->public_key()), editor_name);
}

/// Keys of a drive on this machine alone: made for it, removed with it. `editors`: folder of an editor's key, which stays;
/// empty: nobody edits.
Expected<program::TemporaryFolder> make_keys(const std::vector<std::string>& clients, const fs::path& editors) {
  auto folder = program::TemporaryFolder::make("septet");
  if (!folder) return folder;
  std::string allowed;
  for (const auto& client : clients) {
    const auto identity = net::load_or_create_identity(folder->path() / (client + ".key"));
    if (!identity) return tl::unexpected(identity.error());
    allowed += net::to_text(identity->public_key()) + ' ' + client + '\n';
  }
  const auto server = net::load_or_create_identity(folder->path() / "server.key");
  if (!server) return tl::unexpected(server.error());
  if (!editors.empty()) {
    const auto line = admit_editor(editors, server->public_key());
    if (!line) return tl::unexpected(line.error());
    allowed += *line;
  }
  const auto written = document::write_text_files(
      folder->path(), {{"allowed-clients", allowed}, {"server.public", net::to_text(server->public_key()) + '\n'}});
  if (!written) return tl::unexpected(written.error());
  return folder;
}

/// A screen's program, restarted whenever it dies: the others never notice, and it is back within a second. One that
/// dies repeatedly before it shows a picture is retried more and more rarely.
class RunningScreen {
 public:
  RunningScreen(std::string name, program::ChildOptions options)
      : name_(std::move(name)), options_(std::move(options)) {}

  void keep_running() {
    if (!process_) return start();
    if (process_->read_line(0ms) == "showing") {
      has_shown_ = true;
      deaths_ = 0;
    }
    const auto exit = process_->poll();
    if (!exit || exit->code == 0 || Clock::now() < next_start_) return;
    if (!is_told_) {
      is_told_ = true;
      ++deaths_;
      const auto pause = deaths_ == 1 ? 0ms : std::min(100ms * (1 << std::min(deaths_, 10)), 10'000ms);
      next_start_ = Clock::now() + pause;
      const std::string how = exit->signal != 0 ? fmt::format("was ended by signal {}", exit->signal)
                                                : fmt::format("ended with status {}", exit->code);
      const std::string next =
          is_hopeless() ? "that was its last try"
          : pause > 0ms ? fmt::format("starting it again in {:.1f} s", 1e-3 * static_cast<double>(pause.count()))
                        : "starting it again";
      program::say(fmt::format("\nscreen {} {}; {}; its log: {}", name_, how, next, options_.log.string()));
      return;
    }
    start();
  }
  /// True if it has died in each of its first tries and never shown a picture.
  bool is_hopeless() const { return !has_shown_ && deaths_ >= first_tries; }
  bool is_running() { return process_ && !process_->poll(); }
  const program::ChildOptions& options() const { return options_; }

 private:
  void start() {
    is_told_ = false;
    auto process = program::ChildProcess::start(options_);
    if (process) {
      process_ = std::move(*process);
      return;
    }
    ++deaths_;
    program::say(describe(process.error()));
  }

  /// With the pauses between them more than a second: a display may come a moment late.
  static constexpr int first_tries = 4;
  std::string name_;
  program::ChildOptions options_;
  std::optional<program::ChildProcess> process_;
  bool has_shown_ = false, is_told_ = false;
  int deaths_ = 0;  ///< Since it last showed a picture.
  Clock::time_point next_start_{};
};

program::ChildOptions server_options(const DriveOptions& options, const fs::path& rig, const fs::path& keys) {
  program::ChildOptions server;
  server.program = (program::own_folder() / "septet-server").string();
  server.arguments = {"--rig",      rig.string(),
                      "--keys",     keys.string(),
                      "--out",      options.out.string(),
                      "--seed",     std::to_string(options.seed),
                      "--seconds",  fmt::format("{}", *options.seconds),
                      "--any-port", "--wait-for-screens",
                      "60"};
  const auto add = [&](std::initializer_list<std::string> more) {
    server.arguments.insert(server.arguments.end(), more);
  };
  if (options.replay.empty())
    add({"--scenario", options.scenario, "--traffic", options.traffic});
  else
    add({"--replay", options.replay.string(), "--from", fmt::format("{}", options.replay_from_s)});
  const auto add_chosen = [&](const char* option, const std::string& value) {
    // One word, since a value may begin with a hyphen.
    if (!value.empty()) add({fmt::format("{}={}", option, value)});
  };
  add_chosen("--eyes", options.eyes);
  add_chosen("--driver", options.driver);
  add_chosen("--motion", options.motion);
  if (options.replay.empty()) {
    add_chosen("--to", options.to);
    add_chosen("--language", options.language);
  }
  add_chosen("--vehicle", options.vehicle);
  add_chosen("--models", options.models.string());
  add_chosen("--edits", options.edits.string());
  add_chosen("--save", options.save.string());
  add_chosen("--participant", options.participant);
  for (const auto& about : options.about) add_chosen("--about", about);
  if (options.log == "samples") add({"--log-samples-only"});
  for (const auto& parameter : options.parameters) add_chosen("--parameter", parameter);
  if (!options.begin_from.empty()) {
    add_chosen("--begin-from", options.begin_from.string());
    add({"--begin-at", fmt::format("{}", options.begin_at_s)});
  }
  if (options.page_port) add({"--page", std::to_string(*options.page_port)});
  for (const auto& host : options.page_hosts) add_chosen("--page-host", host);
  if (options.start_now) add({"--start-now"});
  if (options.virtual_screens) add({"--lockstep"});
  if (options.no_screens) add({"--no-screens"});
  if (options.no_sound) add({"--no-sound"});
  return server;
}

program::ChildOptions screen_options(const DriveOptions& options, const rig::Screen& screen, const std::string& server,
                                     const fs::path& keys) {
  program::ChildOptions running;
  running.program = (program::own_folder() / "septet-screen").string();
  running.arguments = {"--name", screen.name,   "--server",   server,
                       "--keys", keys.string(), "--pictures", (options.out / "screens" / screen.name).string()};
  running.log = options.out / "screens" / (screen.name + ".log");
  if (options.full_screen) running.arguments.push_back("--full-screen");
  if (options.virtual_screens) {
    running.arguments.push_back("--virtual");
    // Seven processes share the cores already: further threads of the software rasteriser only get in each other's way.
    if (!std::getenv("LP_NUM_THREADS")) running.environment["LP_NUM_THREADS"] = "0";
  }
  return running;
}

/// The operator's page of a drive: at the same address for every restart of the drive.
struct PagePlace {
  page::ListeningSocket listening;
  std::string token;
};

/// Empty if the drive has no page, or the parent program has handed one over.
Expected<std::optional<PagePlace>> page_place(const DriveOptions& options) {
  if (!options.page_port || std::getenv(page::handover_variable)) return std::nullopt;
  auto listening = page::ListeningSocket::open(static_cast<std::uint16_t>(*options.page_port));
  if (!listening) return tl::unexpected(listening.error());
  return PagePlace{std::move(*listening), page::random_token()};
}

Expected<program::ChildProcess> start_server(program::ChildOptions server, const std::optional<PagePlace>& page) {
  if (!page) return program::ChildProcess::start(server);
  auto handed = page->listening.copy(true);
  if (!handed) return tl::unexpected(handed.error());
  server.environment[page::handover_variable] = page::text_of({*handed, page->token});
  auto process = program::ChildProcess::start(server);
  handed->close();
  return process;
}

/// Ends of server and screens.
struct Ending {
  bool driven = false;  ///< There is something to look at.
  int status = logging::failed_status;
  std::string text;         ///< Last line; empty if the server has printed everything.
  bool again = false;       ///< The driver or the operator wants to begin again.
  bool unseen = false;      ///< No screen could be started.
  double begin_at_s = 0.0;  ///< At the newest state kept until this simulated time; 0: at the start.
};

/// From the server's line "ended NAME TEXT", or from its exit status without that line.
Ending ending_of(const program::ChildExit& exit, const std::optional<std::string>& last_words, bool was_ready) {
  if (last_words) {
    const auto text = last_words->find(' ', std::string_view("ended ").size());
    const auto is_called = [&](logging::DriveEnd end) {
      return last_words->starts_with(fmt::format("ended {} ", logging::name_of(end)));
    };
    return {true, exit.code, text == std::string::npos ? *last_words : last_words->substr(text + 1),
            is_called(logging::DriveEnd::restart), is_called(logging::DriveEnd::no_screens)};
  }
  if (exit.signal != 0 && program::stop_signal() && !was_ready)
    return {false, logging::stopped_status, "stopped before the drive began"};
  if (exit.signal != 0)
    return {was_ready, logging::failed_status,
            fmt::format("the server was ended by signal {}; what it had logged is in the session file", exit.signal)};
  if (exit.code == 127)
    return {false, logging::failed_status, "the server does not start; check that septet-server lies beside septet"};
  if (was_ready)
    return {
        true, logging::failed_status,
        fmt::format("the server ended with status {} and did not say why; what it had logged is in the session file",
                    exit.code)};
  return {false, logging::failed_status, ""};
}

/// Server and screens from start to end.
Expected<Ending> run_processes(const DriveOptions& options, const fs::path& rig_file, const rig::Rig& rig,
                               const std::optional<PagePlace>& page) {
  program::catch_stop_signals();
  std::vector<std::string> clients;
  for (const auto& screen : rig.screens) clients.push_back(screen.name);
  const auto keys = make_keys(clients, options.editors);
  if (!keys) return tl::unexpected(keys.error());
  auto server = start_server(server_options(options, rig_file, keys->path()), page);
  if (!server) return tl::unexpected(server.error());

  // The server says on its standard output which port it got, once it has read and built everything, and why the drive
  // has ended.
  std::vector<RunningScreen> screens;
  const std::string ip = rig.network.interface_address.empty() ? "127.0.0.1" : rig.network.interface_address;
  std::optional<std::string> last_words;
  double begin_at_s = 0.0;
  bool was_ready = false, has_forwarded = false, has_given_up = false;
  const auto listen = [&](std::chrono::milliseconds patience) {
    const auto line = server->read_line(patience);
    if (!line) return false;
    if (line->starts_with("ended ")) last_words = *line;
    if (constexpr std::string_view begin = "begin_at "; line->starts_with(begin))
      std::from_chars(line->data() + begin.size(), line->data() + line->size(), begin_at_s);
    if (!line->starts_with("ready ")) return true;
    was_ready = true;
    if (!options.editors.empty())
      if (auto put =
              document::write_text_file(options.editors / editor::address_file, ip + ':' + line->substr(6) + '\n');
          !put)
        program::say(describe(put.error()));
    if (!options.no_screens)
      for (const auto& screen : rig.screens)
        screens.emplace_back(screen.name, screen_options(options, screen, ip + ':' + line->substr(6), keys->path()));
    return true;
  };
  while (!server->poll()) {
    listen(20ms);
    if (const auto signal = program::stop_signal(); signal && !std::exchange(has_forwarded, true)) {
      program::obey_stop_signal();
      server->send_signal(*signal);
    }
    if (!last_words && !has_given_up)
      for (auto& screen : screens) screen.keep_running();
    if (!screens.empty() && std::ranges::all_of(screens, &RunningScreen::is_hopeless) &&
        !std::exchange(has_given_up, true)) {
      const fs::path& log = screens.front().options().log;
      program::say(fmt::format("septet: no screen can be started; {} says: {}", log.string(), last_line_of(log)));
      server->send_signal(SIGUSR1);
    }
  }
  while (!last_words && listen(0ms)) {
  }
  std::error_code ignored;
  if (!options.editors.empty()) fs::remove(options.editors / editor::address_file, ignored);
  // The screens have had Finish and their reports are in; one that still runs writes its last pictures, or hangs.
  for (int i = 0; i < 1500 && std::ranges::any_of(screens, &RunningScreen::is_running); ++i)
    std::this_thread::sleep_for(20ms);
  Ending ending = ending_of(*server->poll(), last_words, was_ready);
  ending.begin_at_s = begin_at_s;
  return ending;
}

/// Output folder of the drive or the replay. Existing files there are moved aside, so a replay's own session must not
/// be among them.
Expected<fs::path> folder_of(const DriveOptions& options) {
  if (options.replay.empty()) {
    if (!options.out.empty()) return options.out;
    const auto data = program::data_folder();
    if (!data) return tl::unexpected(data.error());
    return *data / "out" / "latest";
  }
  std::error_code error;
  const fs::path session = fs::canonical(options.replay, error);
  if (error) return failure("there is no such file", options.replay.string(), "check the path");
  if (options.out.empty()) return options.replay.parent_path() / "replay";
  const fs::path out = fs::weakly_canonical(options.out, error);
  if (std::ranges::mismatch(out, session).in1 == out.end())
    return failure("the session that is to be shown lies in this folder", options.out.string(),
                   "choose another folder with --out, or leave --out away");
  return options.out;
}

/// Prints the results of a drive.
Expected<void> show_results(const DriveOptions& options, const rig::Rig& rig, int status) {
  const auto tell = [](const fs::path& file, const std::string& what) {
    program::announce(fmt::format("{}: {}", file.string(), what));
  };
  Expected<void> done;
  if (options.virtual_screens && !options.no_screens) {
    done =
        write_panorama(options.out, rig,
                       fs::path(options.replay.empty() ? options.scenario : options.replay.string()).stem().string());
    if (done)
      tell(options.out / "panorama.png",
           fmt::format("what the driver saw, all screens of one tick; each screen once a second is in {}",
                       (options.out / "screens").string()));
  }
  const fs::path session = options.out / "session.sqlite";
  std::error_code ignored;
  if (fs::exists(options.out / "panorama.png", ignored) && fs::exists(options.out / "report.html", ignored)) {
    // The report was written before the panorama existed; a session that could not be closed keeps the end that its
    // server reported.
    const auto reader = logging::SessionReader::open(session);
    if (reader && reader->ended_cleanly())
      if (auto renewed = logging::write_report(*reader, options.out / "report.html"); !renewed && done) done = renewed;
  }
  if (fs::exists(options.out / "report.html", ignored))
    tell(options.out / "report.html", "route, speed, events, lateral position and its histogram, pictures");
  if (fs::exists(session, ignored))
    tell(session, fmt::format("{}{}", status == logging::failed_status ? "what was logged" : "the whole drive",
                              options.log == "samples" ? std::string(", to be measured")
                                                       : fmt::format("; show it again with: {}",
                                                                     typed({"septet", "replay", session.string()}))));
  return done;
}

/// Removes all but the programs' output of a drive without duration that no screen could show.
void remove_undriven(const fs::path& folder) {
  {
    const auto session = logging::SessionReader::open(folder / "session.sqlite");
    const auto span = session ? session->time_span_s() : tl::unexpected(session.error());
    if (!span || (*span && (*span)->second > 0.0)) return;
  }
  std::error_code ignored;
  for (const char* name : {"session.sqlite", "session.sqlite-wal", "session.sqlite-shm", "summary.json", "report.html"})
    fs::remove(folder / name, ignored);
}

/// One drive and its results, in a folder of its own.
Expected<Ending> drive_once(DriveOptions options, const fs::path& rig_file, const rig::Rig& rig,
                            const std::optional<PagePlace>& page) {
  const auto folder = DriveFolder::prepare(options.out);
  if (!folder) return tl::unexpected(folder.error());
  options.out = folder->path();
  // The previous drive was in this folder and kept the state; it has been moved aside.
  if (options.begin_at_s > 0.0) options.begin_from = folder->aside() / "session.sqlite";
  auto ending = run_processes(options, rig_file, rig, page);
  if (!ending || !ending->driven) folder->undo();
  if (!ending) return tl::unexpected(ending.error());
  int& status = ending->status;
  if (ending->unseen && options.replay.empty()) remove_undriven(options.out);
  if (ending->driven) {
    if (!folder->aside().empty()) program::say(fmt::format("The earlier drive is in {}", folder->aside().string()));
    const auto shown = show_results(options, rig, status);
    if (!shown && status == logging::finished_status) {
      program::say("septet: " + describe(shown.error()));
      status = logging::failed_status;
    }
  }
  if (!ending->text.empty())
    (status == logging::failed_status && !ending->driven ? program::say : program::announce)(ending->text);
  return ending;
}

}  // namespace

Expected<int> run_drive(DriveOptions options) {
  if (!has_display()) options.virtual_screens = true;
  if (options.rig.empty()) options.rig = options.virtual_screens ? "seven-screens" : "desktop";
  const auto rig_file = program::find_resource(options.rig, "rigs", ".toml");
  if (!rig_file) return tl::unexpected(rig_file.error());
  const auto rig_text = read_regular_file(*rig_file);
  if (!rig_text) return tl::unexpected(rig_text.error());
  const auto rig = rig::read_rig(*rig_text, rig_file->string());
  if (!rig) return tl::unexpected(rig.error());
  if (options.replay.empty()) {
    const auto found = program::find_resource(options.scenario, "scenarios", ".xosc");
    if (!found) return tl::unexpected(found.error());
    const auto scenario = found->extension() == ".xodr" ? scenario_beside(*found) : found;
    if (!scenario) return tl::unexpected(scenario.error());
    options.scenario = scenario->string();
  }
  if (!options.seconds)
    options.seconds =
        (options.virtual_screens || options.no_screens) && options.replay.empty() ? seconds_unless_told : 0.0;
  const auto out = folder_of(options);
  if (!out) return tl::unexpected(out.error());
  options.out = *out;
  const auto page = page_place(options);
  if (!page) return tl::unexpected(page.error());
  for (const fs::path chosen = options.out;; program::say("\nThe drive begins again.")) {
    options.out = chosen;
    const auto ended = drive_once(options, *rig_file, *rig, *page);
    if (ended) options.begin_at_s = ended->begin_at_s;
    if (!ended || !ended->again) return ended.map([](const Ending& ending) { return ending.status; });
  }
}

}  // namespace septet::server
