#include "sim-server/command/drive_command.hpp"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <thread>
#include <vector>

#include <fmt/core.h>

#include "engine/core/regular_file.hpp"
#include "engine/net/keys.hpp"
#include "engine/rig/rig.hpp"
#include "sim-server/child_process.hpp"
#include "sim-server/panorama_file.hpp"
#include "sim-server/resources.hpp"
#include "sim-server/temporary_folder.hpp"

namespace septet::server {
namespace fs = std::filesystem;
namespace {

volatile std::sig_atomic_t interrupted = 0;  // Written by the signal handler: the one thing it may do.
void on_interrupt(int) { interrupted = 1; }

bool has_display() { return std::getenv("DISPLAY") || std::getenv("WAYLAND_DISPLAY"); }

/// The keys of a drive whose machines are all this one: made for it, gone with it.
Expected<TemporaryFolder> make_keys(const std::vector<std::string>& clients) {
  auto folder = TemporaryFolder::make("septet");
  if (!folder) return folder;
  std::ofstream allowed(folder->path() / "allowed-clients");
  for (const auto& client : clients) {
    const auto identity = net::load_or_create_identity(folder->path() / (client + ".key"));
    if (!identity) return tl::unexpected(identity.error());
    allowed << net::to_text(identity->public_key()) << ' ' << client << '\n';
  }
  const auto server = net::load_or_create_identity(folder->path() / "server.key");
  if (!server) return tl::unexpected(server.error());
  std::ofstream(folder->path() / "server.public") << net::to_text(server->public_key()) << '\n';
  return folder;
}

/// The folder of a drive. An earlier drive in it is moved aside, for a log is never overwritten; anything else is left alone.
class DriveFolder {
 public:
  static Expected<DriveFolder> prepare(const fs::path& chosen) {
    DriveFolder folder;
    folder.path_ = chosen.lexically_normal();
    if (!folder.path_.has_filename()) folder.path_ = folder.path_.parent_path();  // "out/" is "out".
    std::error_code error;
    const auto kind = fs::status(folder.path_, error).type();
    if (kind != fs::file_type::directory && kind != fs::file_type::not_found)
      return failure(kind == fs::file_type::none ? error.message() : "it is a file, not a folder", chosen.string(),
                     "choose a folder for the drive with --out");
    if (kind == fs::file_type::directory && !fs::is_empty(folder.path_, error)) {
      if (!fs::exists(folder.path_ / "session.sqlite", error) && !fs::exists(folder.path_ / "screens", error))
        return failure("the folder holds other things than an earlier drive", chosen.string(), "choose a new or empty one with --out");
      for (int number = 1; folder.aside_.empty() || fs::exists(folder.aside_, error); ++number)
        folder.aside_ = fmt::format("{}.{}", folder.path_.string(), number);
      fs::rename(folder.path_, folder.aside_, error);
      if (error) return failure(error.message(), chosen.string(), "move the earlier drive there out of the way");
    }
    fs::create_directories(folder.path_ / "screens", error);
    if (!error) return folder;
    const auto reason = error.message();
    folder.undo();
    return failure(reason, chosen.string(), "choose a folder that can be written with --out");
  }

  const fs::path& path() const { return path_; }
  const fs::path& aside() const { return aside_; }  ///< Where the earlier drive is now, if there was one.
  /// Nothing was driven: the earlier drive comes back, unless something has been written here.
  void undo() const {
    std::error_code ignored;
    fs::remove(path_ / "screens", ignored);
    fs::remove(path_, ignored);
    if (!aside_.empty() && !fs::exists(path_, ignored)) fs::rename(aside_, path_, ignored);
  }

 private:
  fs::path path_, aside_;
};

struct RunningScreen {
  std::string name;
  ChildOptions options;
  std::optional<ChildProcess> process;
  int starts = 0;
};

/// A screen that died is started again, a few times: the others never noticed, and it is back within a second.
Expected<void> keep_running(RunningScreen& screen) {
  if (screen.process) {
    const auto exit = screen.process->poll();
    if (!exit || exit->code == 0) return {};
    if (exit->code > 0)
      return failure(fmt::format("screen {} ended with status {}", screen.name, exit->code), screen.options.log.string(), "its log says why");
    fmt::print(stderr, "\nscreen {} was ended by signal {}; starting it again\n", screen.name, exit->signal);
  }
  if (++screen.starts > 5)
    return failure(fmt::format("screen {} died five times", screen.name), screen.options.log.string(), "its log says why");
  auto process = ChildProcess::start(screen.options);
  if (!process) return tl::unexpected(process.error());
  screen.process = std::move(*process);
  return {};
}

ChildOptions server_options(const DriveOptions& options, const fs::path& rig, const fs::path& keys) {
  ChildOptions server;
  server.program = (program_folder() / "septet-server").string();
  server.arguments = {"--rig", rig.string(), "--keys", keys.string(), "--out", options.out.string(),
                      "--seed", std::to_string(options.seed), "--seconds", fmt::format("{}", options.seconds), "--any-port", "--wait-for-screens", "60"};
  const auto add = [&](std::initializer_list<std::string> more) { server.arguments.insert(server.arguments.end(), more); };
  if (options.replay.empty()) add({"--scenario", options.scenario, "--traffic", options.traffic});
  else add({"--replay", options.replay.string(), "--from", fmt::format("{}", options.replay_from_s)});
  if (!options.driver.empty()) add({"--driver", options.driver});
  if (options.virtual_screens) add({"--lockstep"});
  if (options.no_screens) add({"--no-screens"});
  return server;
}

RunningScreen screen_options(const DriveOptions& options, const rig::Screen& screen, const std::string& server, const fs::path& keys) {
  RunningScreen running;
  running.name = screen.name;
  running.options.program = (program_folder() / "septet-screen").string();
  running.options.arguments = {"--name", screen.name, "--server", server, "--keys", keys.string(),
                               "--pictures", (options.out / "screens" / screen.name).string()};
  running.options.log = options.out / "screens" / (screen.name + ".log");
  if (options.virtual_screens) {
    running.options.arguments.push_back("--virtual");
    // Seven processes share the cores already: further threads of the software rasteriser only get in each other's way.
    if (!std::getenv("LP_NUM_THREADS")) running.options.environment["LP_NUM_THREADS"] = "0";
  }
  return running;
}

enum class Outcome { driven, gave_up };  ///< Gave up: the server has said why.

/// Server and screens from start to end.
Expected<Outcome> run_processes(const DriveOptions& options, const fs::path& rig_file, const rig::Rig& rig) {
  std::vector<std::string> clients;
  for (const auto& screen : rig.screens) clients.push_back(screen.name);
  const auto keys = make_keys(clients);
  if (!keys) return tl::unexpected(keys.error());
  auto server = ChildProcess::start(server_options(options, rig_file, keys->path()));
  if (!server) return tl::unexpected(server.error());

  // The server says on its standard output which port it got, once it has read and built everything.
  std::optional<std::string> port;
  while (!port && !server->poll() && !interrupted)
    if (const auto line = server->read_line(std::chrono::milliseconds(100)); line && line->starts_with("ready "))
      port = line->substr(6);
  if (!port && server->poll() && server->poll()->code == 1) return Outcome::gave_up;
  std::vector<RunningScreen> screens;
  const std::string ip = rig.network.interface_address.empty() ? "127.0.0.1" : rig.network.interface_address;
  if (port && !options.no_screens)
    for (const auto& screen : rig.screens) screens.push_back(screen_options(options, screen, ip + ':' + *port, keys->path()));

  Expected<void> outcome;
  while (outcome && !server->poll()) {
    for (auto& screen : screens)
      if (outcome) outcome = keep_running(screen);
    if (interrupted) {
      server->send_signal(SIGTERM);
      interrupted = 0;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  if (!outcome) {
    server->stop();
    return tl::unexpected(outcome.error());
  }
  // The screens have had Finish and their reports are in; whoever still runs is not waited for long.
  for (int i = 0; i < 250; ++i) {
    bool running = false;
    for (auto& screen : screens) running = running || (screen.process && !screen.process->poll());
    if (!running) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  const auto exit = *server->poll();
  if (exit.signal != 0) return failure(fmt::format("the server was ended by signal {}", exit.signal), "septet-server", "what it had logged is in the session file");
  if (exit.code == 1) return Outcome::gave_up;
  if (exit.code != 0) return failure(fmt::format("the server ended with status {}", exit.code), "septet-server", "check that it lies beside septet");
  return Outcome::driven;
}

int fail(const Error& error) {
  fmt::print(stderr, "septet: {}\n", describe(error));
  return 1;
}

}  // namespace

int run_drive(DriveOptions options) {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  if (!has_display()) options.virtual_screens = true;
  if (options.rig.empty()) options.rig = options.virtual_screens ? "seven-screens" : "desktop";
  const auto rig_file = find_resource(options.rig, "rigs", ".toml");
  if (!rig_file) return fail(rig_file.error());
  const auto rig_text = read_regular_file(*rig_file);
  if (!rig_text) return fail(rig_text.error());
  const auto rig = rig::read_rig(*rig_text, rig_file->string());
  if (!rig) return fail(rig.error());
  if (options.replay.empty()) {
    const auto scenario = find_resource(options.scenario, "scenarios", ".xosc");
    if (!scenario) return fail(scenario.error());
    options.scenario = scenario->string();
  }
  if (options.virtual_screens && options.seconds <= 0.0 && options.replay.empty()) options.seconds = 30.0;
  if (options.out.empty()) {
    const auto data = data_folder();
    if (!data) return fail(data.error());
    options.out = *data / "out" / "latest";
  }
  const auto folder = DriveFolder::prepare(options.out);
  if (!folder) return fail(folder.error());
  options.out = folder->path();
  const auto outcome = run_processes(options, *rig_file, *rig);
  if (!outcome || *outcome == Outcome::gave_up) folder->undo();
  if (!outcome) return fail(outcome.error());
  if (*outcome == Outcome::gave_up) return 1;
  if (!folder->aside().empty()) fmt::print(stderr, "The earlier drive is in {}\n", folder->aside().string());

  if (options.virtual_screens && !options.no_screens) {
    const auto panorama = write_panorama(options.out, *rig, fs::path(options.replay.empty() ? options.scenario : options.replay.string()).stem().string());
    if (!panorama) return fail(panorama.error());
    fmt::print("{}: what the driver saw, all screens of one tick; each screen once a second is in {}\n", (options.out / "panorama.png").string(), (options.out / "screens").string());
  }
  if (options.replay.empty()) {
    fmt::print("{}: speed, lateral position and its histogram\n", (options.out / "report.html").string());
    fmt::print("{}: the whole drive; show it again with: septet replay {}\n", (options.out / "session.sqlite").string(), (options.out / "session.sqlite").string());
  }
  return 0;
}

}  // namespace septet::server
