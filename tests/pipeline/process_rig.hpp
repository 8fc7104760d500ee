#pragma once
/// Septet's programs as processes, on a small rig in a folder of their own. Every wait is bounded.

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "engine/net/keys.hpp"
#include "engine/net/udp_socket.hpp"
#include "program/child_process.hpp"
#include "tests/checkout.hpp"
#include "tests/shipped_files.hpp"
#include "tests/temporary_folder.hpp"

namespace septet::pipeline {
namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
/// Longest wait for an event: only a hang takes so long, however busy the machine.
inline constexpr std::chrono::milliseconds patience = 10min;

inline void write_text(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

/// True if the condition holds before the time is up; checked a hundred times a second.
inline bool becomes_true(const std::function<bool()>& condition, std::chrono::milliseconds within = patience) {
  const auto until = Clock::now() + within;
  while (!condition()) {
    if (Clock::now() > until) return false;
    std::this_thread::sleep_for(10ms);
  }
  return true;
}

/// Small screens side by side, called a, b, c …; `network` and `car` are further lines of those tables.
inline std::string small_rig(int screens, const std::string& network = "",
                             const std::string& car = "source = \"simulated-driver\"") {
  std::string rig =
      fmt::format("name = \"small\"\neye_point_m = [1.35, 0.37, 1.17]\n\n[network]\n{}\n\n[car]\n{}\n", network, car);
  for (int i = 0; i < screens; ++i) {
    const double left = 0.37 + 0.8 * (0.5 * screens - i), right = left - 0.8;
    rig += fmt::format(
        "\n[[screen]]\nname = \"{}\"\nwidth_px = 160\nheight_px = 120\nlower_left_m = [2.15, {:.3f}, 0.87]\n"
        "lower_right_m = [2.15, {:.3f}, 0.87]\nupper_left_m = [2.15, {:.3f}, 1.47]\n",
        static_cast<char>('a' + i), left, right, left);
  }
  return rig;
}

inline program::ChildProcess start(const std::string& program, std::vector<std::string> arguments, const fs::path& log,
                                   std::map<std::string, std::string> environment = {}) {
  environment.insert({{"LP_NUM_THREADS", "0"}, {"SEPTET_DATA", source_folder()}});
  auto process = program::ChildProcess::start({.program = (fs::path(build_folder()) / program).string(),
                                               .arguments = std::move(arguments),
                                               .environment = std::move(environment),
                                               .log = log});
  REQUIRE(process.has_value());
  return std::move(*process);
}

/// Waits for the end; −2 if it does not come.
inline int exit_code(program::ChildProcess& process, std::chrono::milliseconds within = patience) {
  if (!becomes_true([&] { return process.poll().has_value(); }, within)) return -2;
  return process.poll()->code;
}

struct Ended {
  int code = 0;
  std::string error;  ///< Its standard error.
};

/// A program from start to end.
inline Ended run(const std::string& program, std::vector<std::string> arguments, const fs::path& log,
                 std::map<std::string, std::string> environment = {}) {
  auto process = start(program, std::move(arguments), log, std::move(environment));
  const int code = exit_code(process);
  return {code, text_of(log)};
}

/// Checks for an exit status other than 0, one line that names fault and place, and nothing at `out`.
inline void check_refused(const Ended& ended, const std::vector<std::string>& words, const fs::path& out) {
  INFO(ended.error);
  CHECK(ended.code > 0);
  CHECK(std::ranges::count(ended.error, '\n') == 1);
  for (const auto& word : words) {
    CAPTURE(word);
    CHECK(ended.error.find(word) != std::string::npos);
  }
  CHECK_FALSE(fs::exists(out));
}

/// Keys of a server and of its known screens.
inline fs::path make_keys(const fs::path& folder, const std::string& screens) {
  fs::create_directories(folder);
  std::string allowed;
  for (const char name : screens) {
    const auto identity = net::load_or_create_identity(folder / (std::string(1, name) + ".key"));
    REQUIRE(identity.has_value());
    allowed += net::to_text(identity->public_key()) + ' ' + name + '\n';
  }
  write_text(folder / "allowed-clients", allowed);
  const auto server = net::load_or_create_identity(folder / "server.key");
  REQUIRE(server.has_value());
  write_text(folder / "server.public", net::to_text(server->public_key()) + '\n');
  return folder;
}

/// A UDP port that is free now.
inline std::uint16_t free_port() {
  const auto socket = net::UdpSocket::open({.bind = {net::loopback_ip, 0}});
  REQUIRE(socket.has_value());
  return socket->local_address().port;
}

/// Waits for the server's "ready PORT".
inline std::string ready_port(program::ChildProcess& server, const fs::path& log) {
  const auto line = server.read_line(patience);
  INFO(text_of(log));
  REQUIRE(line.has_value());
  REQUIRE(line->starts_with("ready "));
  return line->substr(6);
}

inline program::ChildProcess start_screen(const std::string& name, const std::string& port, const fs::path& keys,
                                          const fs::path& pictures) {
  fs::create_directories(pictures);
  return start("septet-screen",
               {"--name", name, "--server", "127.0.0.1:" + port, "--keys", keys.string(), "--virtual", "--pictures",
                (pictures / name).string()},
               pictures / (name + ".log"));
}

/// The newest tick with a kept picture of a screen, 0 without one.
inline long newest_picture(const fs::path& folder) {
  long newest = 0;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    newest = std::max(newest, std::strtol(entry.path().stem().c_str(), nullptr, 10));
  return newest;
}

inline double seconds_since(Clock::time_point begun) {
  return std::chrono::duration<double>(Clock::now() - begun).count();
}

}  // namespace septet::pipeline
