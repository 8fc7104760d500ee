#include <sys/stat.h>

#include <csignal>

#include "logging/session/session_reader.hpp"
#include "tests/checkout.hpp"
#include "tests/pipeline/process_rig.hpp"
#include "tests/pipeline/x_display.hpp"

namespace septet::pipeline {
namespace {

/// The meta row with the reason of the drive's end; "none" if the log cannot be read or has none.
std::string why(const fs::path& out) {
  const auto session = logging::SessionReader::open(out / "session.sqlite");
  if (!session || !session->info().other.contains("ended_why")) return "none";
  return session->info().other.at("ended_why");
}

bool is_driving(const fs::path& out) {
  std::error_code ignored;
  if (!fs::exists(out / "session.sqlite", ignored)) return false;
  const auto session = logging::SessionReader::open(out / "session.sqlite");
  const auto span = session ? session->time_span_s() : Expected<std::optional<std::pair<double, double>>>();
  return span && *span && (*span)->second > 0.1;
}

std::vector<std::string> headless(const fs::path& out, const std::string& seconds) {
  return {"drive", "--no-screens", "--seconds", seconds, "--out", out.string()};
}

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// The last line of a program's standard output, once it has ended.
std::string last_words(program::ChildProcess& process) {
  std::string last;
  while (const auto line = process.read_line(1s)) last = *line;
  return last;
}

void check_results(const fs::path& out) {
  CHECK(fs::exists(out / "summary.json"));
  CHECK(fs::exists(out / "report.html"));
}

}  // namespace

TEST_CASE("a drive ends when the scenario's StopTrigger fires and when its time is over and says so") {
  const TemporaryFolder folder;
  fs::create_directories(folder / "short");
  for (const auto& entry : fs::directory_iterator(fs::path(source_folder()) / "scenarios/motorway-ambulance"))
    fs::copy(entry.path(), folder / "short" / entry.path().filename(), fs::copy_options::recursive);
  const fs::path scenario = folder / "short" / "motorway-ambulance.xosc";
  std::string text = text_of(scenario);
  const std::string distance = "TraveledDistanceCondition value=\"9000\"";
  const auto at = text.rfind(distance);
  REQUIRE(at != std::string::npos);
  write_text(scenario, text.replace(at, distance.size(), "TraveledDistanceCondition value=\"50\""));
  auto arguments = headless(folder / "out", "0");
  arguments.insert(arguments.end(), {"--scenario", scenario.string()});
  auto drive = start("septet", arguments, folder / "err");
  REQUIRE(exit_code(drive) == 0);
  CHECK(last_words(drive).find("StopTrigger") != std::string::npos);
  CHECK(why(folder / "out") == "stop_trigger");
  check_results(folder / "out");

  auto timed = start("septet", headless(folder / "timed", "0.5"), folder / "err");
  REQUIRE(exit_code(timed) == 0);
  CHECK(last_words(timed).find("time") != std::string::npos);
  CHECK(why(folder / "timed") == "time_over");
}

TEST_CASE("a signal ends a drive in order with its own reason and status 3 and no key stays behind") {
  std::signal(SIGHUP, SIG_DFL);  // Also where the tests run under nohup.
  struct End {
    int signal;
    const char* reason;
  };
  for (const End& end : {End{SIGINT, "interrupted"}, End{SIGTERM, "terminated"}, End{SIGHUP, "hung_up"}}) {
    CAPTURE(end.reason);
    const TemporaryFolder folder;
    fs::create_directories(folder / "tmp");
    // Zero seconds: until it is stopped.
    auto drive = start("septet", headless(folder / "out", "0"), folder / "err", {{"TMPDIR", folder / "tmp"}});
    REQUIRE(becomes_true([&] { return is_driving(folder / "out"); }));
    CHECK(entries(folder / "tmp") == 1);
    drive.send_signal(end.signal);
    const int code = exit_code(drive);
    INFO(text_of(folder / "err"));
    CHECK(code == 3);
    CHECK(why(folder / "out") == end.reason);
    check_results(folder / "out");
    CHECK(entries(folder / "tmp") == 0);
  }
}

TEST_CASE("a server that still reads its files is ended at once by a signal") {
  std::signal(SIGHUP, SIG_DFL);
  const TemporaryFolder folder;
  const fs::path keys = make_keys(folder / "keys", "");
  fs::remove(keys / "allowed-clients");
  REQUIRE(::mkfifo((keys / "allowed-clients").c_str(), 0600) == 0);  // It never has a writer.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    CAPTURE(signal);
    auto server = start("septet-server", {"--keys", keys.string(), "--any-port", "--out", (folder / "out").string()},
                        folder / "err");
    CHECK_FALSE(server.read_line(1s).has_value());
    server.send_signal(signal);
    REQUIRE(becomes_true([&] { return server.poll().has_value(); }));
    CHECK(server.poll()->signal == signal);
    CHECK_FALSE(fs::exists(folder / "out"));
  }
}

TEST_CASE("a killed drive takes its server and its keys along") {
  const TemporaryFolder folder;
  fs::create_directories(folder / "tmp");
  const std::map<std::string, std::string> place{{"TMPDIR", folder / "tmp"}};
  auto drive = start("septet", headless(folder / "out", "0"), folder / "err", place);
  REQUIRE(becomes_true([&] { return is_driving(folder / "out"); }));
  drive.send_signal(SIGKILL);
  // The server is notified and ends in order.
  CHECK(becomes_true([&] { return why(folder / "out") == "terminated"; }));
  CHECK(becomes_true([&] { return entries(folder / "tmp") == 0; }));
}

TEST_CASE("a log that is deleted ends the drive soon and one that reaches a limit of its size too") {
  const TemporaryFolder folder;
  auto drive = start("septet", headless(folder / "out", "0"), folder / "err");
  REQUIRE(becomes_true([&] { return is_driving(folder / "out"); }));
  fs::remove(folder / "out" / "session.sqlite");
  CHECK(exit_code(drive) == 1);
  CHECK(text_of(folder / "err").find("deleted") != std::string::npos);
  CHECK(last_words(drive).find("the log cannot be written") != std::string::npos);

  // 30 MB: the world is in, and a minute of the drive.
  auto limited = start(
      "/bin/sh",
      {"-c",
       fmt::format("ulimit -f 60000; exec '{}' drive --no-screens --scenario behind-ambulance --seconds 0 --out '{}'",
                   (fs::path(build_folder()) / "septet").string(), (folder / "limited").string())},
      folder / "limited.err");
  CHECK(exit_code(limited) == 1);
  const std::string said = text_of(folder / "limited.err");
  INFO(said);
  CHECK(said.find("limited/session.sqlite") != std::string::npos);
  CHECK(run("septet", {"replay", "--verify", (folder / "limited" / "session.sqlite").string()}, folder / "verify.err")
            .code == 0);
}

TEST_CASE("a killed drive's session is checked also where no file may grow") {
  const TemporaryFolder folder;
  auto server =
      start("septet-server", {"--no-screens", "--keys", folder.path().string(), "--out", (folder / "out").string()},
            folder / "err");
  const fs::path session = folder / "out" / "session.sqlite", wal = session.string() + "-wal";
  REQUIRE(becomes_true([&] { return (fs::exists(wal) && fs::file_size(wal) > 0) || server.poll(); }));
  server.send_signal(SIGKILL);
  CHECK(exit_code(server) == -1);
  REQUIRE(fs::exists(wal));
  fs::remove(session.string() + "-shm");  // The WAL's index, which a reader recreates.
  auto check = start("/bin/sh",
                     {"-c", fmt::format("ulimit -f 8; exec '{}' check '{}'",
                                        (fs::path(build_folder()) / "septet").string(), session.string())},
                     folder / "check.err");
  CHECK(exit_code(check) == 1);  // Not −1, ended by a signal.
  CHECK(last_words(check) == "1 files, 1 errors, 0 warnings");
}

TEST_CASE("a log that is deleted while the server waits for its screens ends it") {
  const TemporaryFolder folder;
  write_text(folder / "small.toml", small_rig(1));
  auto server = start("septet-server",
                      {"--rig", (folder / "small.toml").string(), "--keys", make_keys(folder / "keys", "a").string(),
                       "--out", (folder / "out").string(), "--any-port"},
                      folder / "err");
  ready_port(server, folder / "err");
  fs::remove(folder / "out" / "session.sqlite");
  CHECK(exit_code(server) == 1);
  CHECK(text_of(folder / "err").find("deleted") != std::string::npos);
  CHECK(last_words(server).starts_with("ended log_failed"));
}

TEST_CASE("closing the window ends the drive, and Escape pauses it, where Enter ends it") {
  const TemporaryFolder folder;
  const XDisplay display;
  write_text(folder / "small.toml", small_rig(1));
  for (const std::string end : {"window_closed", "escape"}) {
    CAPTURE(end);
    const fs::path out = folder / end;
    auto drive = start("septet", {"drive", "--rig", (folder / "small.toml").string(), "--out", out.string()},
                       folder / "err", display.environment());
    REQUIRE(becomes_true([&] { return newest_picture(out / "screens" / "a") > 0; }));
    if (end == "escape") {
      display.press_escape("Septet a");
      REQUIRE(becomes_true([&] { return text_of(folder / "err").find("paused by the driver") != std::string::npos; }));
      display.press_enter("Septet a");
    } else {
      display.close_window("Septet a");
    }
    const int code = exit_code(drive);
    INFO(text_of(folder / "err"));
    CHECK(code == 3);
    CHECK(why(out) == end);
    check_results(out);
  }
}

TEST_CASE("Escape and Enter end the drive also at a screen that the server has dropped") {
  const TemporaryFolder folder;
  const XDisplay display;
  write_text(folder / "small.toml", small_rig(1));
  const fs::path keys = make_keys(folder / "keys", "a"), out = folder / "out";
  auto server = start("septet-server",
                      {"--rig", (folder / "small.toml").string(), "--keys", keys.string(), "--any-port", "--seconds",
                       "60", "--out", out.string()},
                      folder / "server.err");
  const std::string port = ready_port(server, folder / "server.err");
  auto screen = start("septet-screen", {"--name", "a", "--server", "127.0.0.1:" + port, "--keys", keys.string()},
                      folder / "screen.err", display.environment());
  REQUIRE(screen.read_line(patience) == "showing");
  screen.send_signal(SIGSTOP);  // As on a machine that has no time for it.
  REQUIRE(becomes_true([&] { return text_of(folder / "server.err").find("screen a left") != std::string::npos; }));
  display.press_escape("Septet a");
  screen.send_signal(SIGCONT);
  REQUIRE(
      becomes_true([&] { return text_of(folder / "server.err").find("paused by the driver") != std::string::npos; }));
  display.press_enter("Septet a");
  const int code = exit_code(server);
  INFO(text_of(folder / "server.err"));
  CHECK(code == 3);
  CHECK(why(out) == "escape");
  CHECK(exit_code(screen) == 0);
}

TEST_CASE(
    "a screen that fails is tried again and costs the others nothing and where none can start the drive says so") {
  const TemporaryFolder folder;
  const XDisplay display;
  write_text(folder / "small.toml", small_rig(2));
  const fs::path out = folder / "out";
  auto drive =
      start("septet", {"drive", "--seconds", "4", "--rig", (folder / "small.toml").string(), "--out", out.string()},
            folder / "err", display.environment());
  REQUIRE(becomes_true([&] { return fs::exists(out / "screens"); }));
  write_text(out / "screens" / "b", "a file where the screen wants its folder");
  const int code = exit_code(drive);
  const std::string said = text_of(folder / "err");
  INFO(said);
  CHECK(code == 0);
  CHECK(said.find("screen b ended with status 1") != std::string::npos);
  CHECK(newest_picture(out / "screens" / "a") > 0);
  CHECK(why(out) == "time_over");
  check_results(out);

  // To X an empty name is no display either: services and cron set it so.
  auto nameless = start(
      "septet",
      {"drive", "--seconds", "0.1", "--rig", (folder / "small.toml").string(), "--out", (folder / "nameless").string()},
      folder / "nameless.err", {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}});
  CHECK(exit_code(nameless) == 0);
  CHECK(fs::exists(folder / "nameless" / "panorama.png"));

  auto blind = start(
      "septet",
      {"drive", "--seconds", "300", "--rig", (folder / "small.toml").string(), "--out", (folder / "blind").string()},
      folder / "blind.err", {{"DISPLAY", ":4711"}});
  CHECK(exit_code(blind) == 1);
  const std::string complaint = text_of(folder / "blind.err");
  INFO(complaint);
  CHECK(complaint.find("no screen can be started") != std::string::npos);
  CHECK(complaint.find("screens/a.log") != std::string::npos);
  // The server has let each try in without waiting for the one before to fall silent.
  CHECK(complaint.find("screen a left: it said goodbye") != std::string::npos);
  CHECK(complaint.find("not heard for") == std::string::npos);
  CHECK(last_words(blind).find("no screen could be started") != std::string::npos);
  // The world waited for its driver meanwhile: the only results are the screens' outputs.
  for (const char* name : {"session.sqlite", "summary.json", "report.html"})
    CHECK_FALSE(fs::exists(folder / "blind" / name));
  CHECK(fs::exists(folder / "blind" / "screens" / "a.log"));
}

}  // namespace septet::pipeline
