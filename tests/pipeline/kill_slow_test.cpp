#include <csignal>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/image/png.hpp"
#include "logging/session/session_reader.hpp"
#include "tests/pipeline/observer.hpp"

namespace septet::pipeline {
namespace {

int child_called(int parent, const std::string& name) {
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string id = entry.path().filename();
    if (id.find_first_not_of("0123456789") != std::string::npos) continue;
    const std::string stat = text_of(entry.path() / "stat"), line = text_of(entry.path() / "cmdline");
    const auto after_name = stat.rfind(") ");
    if (after_name == std::string::npos || std::atoi(stat.c_str() + after_name + 4) != parent) continue;
    if (line.find(std::string("--name") + '\0' + name + '\0') != std::string::npos) return std::stoi(id);
  }
  return 0;
}

/// True if every thread of a process has stopped.
bool is_stopped(int process) {
  for (const auto& thread : fs::directory_iterator(fmt::format("/proc/{}/task", process))) {
    const std::string stat = text_of(thread.path() / "stat");
    const auto after_name = stat.rfind(") ");
    if (after_name == std::string::npos || stat[after_name + 2] != 'T') return false;
  }
  return true;
}

/// The time of the newest tick that a log holds, 0 without one.
double logged_s(const fs::path& file) {
  const auto session = logging::SessionReader::open(file);
  const auto span = session ? session->time_span_s() : Expected<std::optional<std::pair<double, double>>>();
  return span && *span ? (*span)->second : 0.0;
}

/// A screen's entry in summary.json.
nlohmann::json screen_in(const fs::path& summary, const std::string& screen) {
  const auto json = nlohmann::json::parse(text_of(summary), nullptr, false);
  if (json.is_object())
    for (const auto& entry : json.at("screens"))
      if (entry.at("name") == screen) return entry;
  return {{"frames", -1}};
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t number = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++number;
  return number;
}

std::vector<std::string> server_arguments(const TemporaryFolder& folder, const std::string& out) {
  return {"--rig",
          (folder / "small.toml").string(),
          "--keys",
          (folder / "keys").string(),
          "--out",
          (folder / out).string(),
          "--wait-for-screens",
          "0"};
}

}  // namespace

TEST_CASE("a killed screen costs the others no frame and is back by itself") {
  const TemporaryFolder folder;
  write_text(folder / "small.toml", small_rig(3));
  const fs::path log = folder / "err", out = folder / "out";
  auto drive = start(
      "septet",
      {"drive", "--virtual", "--seconds", "8", "--rig", (folder / "small.toml").string(), "--out", out.string()}, log);
  REQUIRE(becomes_true([&] { return newest_picture(out / "screens" / "b") >= 120; }));
  const int victim = child_called(drive.process_id(), "b");
  REQUIRE(victim > 0);
  REQUIRE(::kill(victim, SIGKILL) == 0);
  const bool noticed =
      becomes_true([&] { return text_of(log).find("screen b was ended by signal 9") != std::string::npos; });
  const auto restarted = Clock::now();
  const bool back = becomes_true([&] { return count(text_of(log), "screen b shows tick") == 2; });
  const double back_s = seconds_since(restarted);
  INFO(text_of(log));
  CHECK(noticed);
  CHECK(back);
  MESSAGE("the killed screen presented again " << back_s << " s after it was started again");
  REQUIRE(exit_code(drive) == 0);
  for (const char* other : {"a", "c"}) {
    const auto screen = screen_in(out / "summary.json", other);
    CHECK(screen["frames"] == 120);
    CHECK(screen["left_s"].empty());
  }
  const auto screen = screen_in(out / "summary.json", "b");
  CHECK(screen["frames"] > 0);
  // It may miss no frame: in lockstep the others wait until it is known to be gone.
  CHECK(screen["frames"] <= 120);
  CHECK(screen["connected_s"].size() == 2);
  CHECK(screen["left_s"].size() == 1);
  CHECK(fs::exists(out / "screens" / "b" / "960.png"));
}

TEST_CASE("a screen that hangs costs the others nothing and is back when it goes on") {
  const TemporaryFolder folder;
  write_text(folder / "small.toml", small_rig(2));
  make_keys(folder / "keys", "ab");
  auto arguments = server_arguments(folder, "out");
  arguments.push_back("--any-port");
  auto server = start("septet-server", arguments, folder / "server.err");
  const std::string port = ready_port(server, folder / "server.err");
  const fs::path pictures = folder / "pictures";
  auto a = start_screen("a", port, folder / "keys", pictures);
  auto b = start_screen("b", port, folder / "keys", pictures);
  const auto a_shows = [&] { return newest_picture(pictures / "a"); };
  const auto b_shows = [&] { return newest_picture(pictures / "b"); };
  REQUIRE(becomes_true([&] { return a_shows() > 0 && b_shows() > 0; }));
  b.send_signal(SIGSTOP);
  REQUIRE(becomes_true([&] { return is_stopped(b.process_id()); }));
  const long a_before = a_shows(), b_before = b_shows();
  // Longer than the server's patience, so that it lets the screen go and has to take it back.
  CHECK(becomes_true([&] { return a_shows() > a_before + 6 * 120; }));
  CHECK(b_shows() == b_before);
  const long a_now = a_shows();
  b.send_signal(SIGCONT);
  CHECK(becomes_true([&] { return b_shows() > a_now; }));
  server.send_signal(SIGTERM);
  INFO(text_of(folder / "server.err"));
  CHECK(exit_code(server) == 3);
  CHECK(exit_code(a) == 0);
  CHECK(exit_code(b) == 0);
}

TEST_CASE(
    "screens hold the picture of a killed server and return to the next one and its log is whole but for its end") {
  const TemporaryFolder folder;
  const std::string port = std::to_string(free_port());
  write_text(folder / "small.toml",
             small_rig(2, "scene_port = " + port + "\ntick_port = " + std::to_string(free_port())));
  const fs::path keys = make_keys(folder / "keys", "ab"), pictures = folder / "pictures";
  auto server = start("septet-server", server_arguments(folder, "first"), folder / "first.err");
  ready_port(server, folder / "first.err");
  auto a = start_screen("a", port, keys, pictures);
  Observer observer("b", port, *net::load_identity(keys / "b.key"), keys);
  const fs::path log = folder / "first" / "session.sqlite";
  REQUIRE(observer.watch(
      [&] { return observer.newest_tick() > 240 && newest_picture(pictures / "a") > 120 && logged_s(log) > 1.0; }));
  server.send_signal(SIGKILL);
  CHECK(exit_code(server) == -1);
  const auto killed = Clock::now();
  observer.watch([] { return false; }, 200ms);
  const Tick reached = observer.newest_tick();
  {
    const auto session = logging::SessionReader::open(log);
    REQUIRE(session.has_value());
    CHECK(session->check_integrity().has_value());
    CHECK_FALSE(session->ended_cleanly());
    const auto span = session->time_span_s();
    REQUIRE((span && *span));
    MESSAGE("the killed server's log lacks the last " << static_cast<double>(reached) / 120.0 - (*span)->second
                                                      << " s");
    CHECK((*span)->second > 1.0);  // Its earlier content is still there; session_kill_slow_test tests the rest.
  }
  const fs::path held = pictures / "a" / "server-lost.png";
  CHECK(becomes_true([&] { return fs::exists(held) && image::read_png(held).has_value(); }));
  MESSAGE("the screen said that the server was gone " << seconds_since(killed) << " s after it was killed");

  const long before = newest_picture(pictures / "a");
  for (const auto& entry : fs::directory_iterator(pictures / "a"))
    if (entry.path() != held) fs::remove(entry.path());
  auto next = start("septet-server", server_arguments(folder, "second"), folder / "second.err");
  ready_port(next, folder / "second.err");
  const auto ready = Clock::now();
  CHECK(becomes_true([&] { return text_of(folder / "second.err").find("screen a shows tick") != std::string::npos; }));
  MESSAGE("the screen showed the new server's drive " << seconds_since(ready)
                                                      << " s after it was ready; it had shown tick " << before);
  CHECK(becomes_true([&] { return newest_picture(pictures / "a") > 0; }));
  CHECK(observer.watch(
      [&] { return observer.link().state() == net::ClientState::connected && observer.newest_tick() > 0; }));
  CHECK_FALSE(a.poll().has_value());
}

TEST_CASE("a client that is not on the allow-list gets nothing") {
  const TemporaryFolder folder;
  write_text(folder / "small.toml", small_rig(2, "transport = \"unicast\""));
  const fs::path keys = make_keys(folder / "keys", "a");
  auto arguments = server_arguments(folder, "out");
  arguments.push_back("--any-port");
  auto server = start("septet-server", arguments, folder / "server.err");
  const std::string port = ready_port(server, folder / "server.err");
  Observer stranger("b", port, net::Identity::generate(), keys),
      friendly("a", port, *net::load_identity(keys / "a.key"), keys);
  CHECK(friendly.watch([&] { return friendly.newest_tick() > 0 && friendly.link().scene_arrived(); }));
  // For as long as it takes the server to refuse it and to send the other one two further seconds of the drive.
  const Tick seen = friendly.newest_tick();
  bool has_got = false;
  CHECK(stranger.watch([&] {
    has_got = has_got || stranger.link().state() == net::ClientState::connected || stranger.link().welcome() ||
              stranger.newest_tick() > 0 || stranger.link().scene_arrived();
    return friendly.watch([] { return true; }) && friendly.newest_tick() > seen + 240 &&
           text_of(folder / "server.err").find("refused a client") != std::string::npos;
  }));
  CHECK_FALSE(has_got);
}

}  // namespace septet::pipeline
