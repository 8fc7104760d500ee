/// A first user's experience: a waiting world, a full screen, a visible window.

#include <csignal>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "logging/session/session_reader.hpp"
#include "tests/pipeline/process_rig.hpp"
#include "tests/pipeline/x_display.hpp"

namespace septet::pipeline {
namespace {

bool says(const fs::path& log, const std::string& words) { return text_of(log).find(words) != std::string::npos; }

/// The text after those words in each line with them.
std::vector<std::string> each_after(const std::string& words, const fs::path& log) {
  std::vector<std::string> found;
  std::istringstream lines(text_of(log));
  for (std::string line; std::getline(lines, line);)
    if (const auto at = line.find(words); at != std::string::npos) found.push_back(line.substr(at + words.size()));
  return found;
}

}  // namespace

TEST_CASE(
    "a world in a window waits at its first tick until the driver presses a key and then log and verification agree") {
  const TemporaryFolder folder;
  const XDisplay display;
  write_text(folder / "small.toml", small_rig(1, "", "source = \"keyboard\""));
  const fs::path out = folder / "out", log = folder / "err", session = out / "session.sqlite";
  auto drive =
      start("septet", {"drive", "--seconds", "0.5", "--rig", (folder / "small.toml").string(), "--out", out.string()},
            log, display.environment());
  const bool shows = becomes_true([&] { return drive.poll() || says(log, "screen a shows tick 0"); });
  INFO(text_of(log));
  REQUIRE(shows);
  CHECK(says(log, "the world waits for the driver: Press any key to start"));
  std::this_thread::sleep_for(1s);  // Twice as long as the drive would take.
  REQUIRE_FALSE(drive.poll().has_value());
  display.tap_arrow_up("Septet a");
  REQUIRE(becomes_true([&] { return drive.poll() || says(log, "the drive's end stays on the screens"); }));
  std::this_thread::sleep_for(1s);
  REQUIRE_FALSE(drive.poll().has_value());
  display.press_enter("Septet a");
  REQUIRE(exit_code(drive) == 0);
  CHECK(says(log, "the driver took the controls after"));
  const auto summary = nlohmann::json::parse(text_of(out / "summary.json"));
  CHECK(summary["ticks"] == 60);
  CHECK(summary["screens"][0]["frames"] > 0);
  const auto read = logging::SessionReader::open(session);
  REQUIRE(read.has_value());
  auto snapshots = read->snapshots().value();
  for (Tick tick = 0; tick <= 60; ++tick) {
    const auto snapshot = snapshots.next().value();
    REQUIRE(snapshot.has_value());
    CHECK(snapshot->tick == tick);
  }
  const Ended verified = run("septet", {"replay", "--verify", session.string()}, folder / "verify.err");
  CHECK_MESSAGE(verified.code == 0, verified.error);
}

TEST_CASE("keys are read while a picture is drawn: a slow picture holds up no hand") {
  const TemporaryFolder folder;
  const XDisplay display;
  std::string rig = small_rig(1, "", "source = \"keyboard\"");
  rig.replace(rig.find("width_px = 160"), 14, "width_px = 1600");
  rig.replace(rig.find("height_px = 120"), 15, "height_px = 1200");
  write_text(folder / "large.toml", rig);
  const fs::path out = folder / "out", log = folder / "err";
  auto drive =
      start("septet", {"drive", "--seconds", "1.5", "--rig", (folder / "large.toml").string(), "--out", out.string()},
            log, display.environment());
  REQUIRE(becomes_true([&] { return drive.poll() || says(log, "screen a shows tick 0"); }));
  display.tap_arrow_up("Septet a");
  INFO(text_of(log));
  REQUIRE(becomes_true([&] { return drive.poll() || says(log, "the drive's end stays on the screens"); }));
  display.press_enter("Septet a");
  REQUIRE(exit_code(drive) == 0);
  const auto summary = nlohmann::json::parse(text_of(out / "summary.json"));
  const auto read = logging::SessionReader::open(out / "session.sqlite");
  REQUIRE(read.has_value());
  // Each reading of the keys has a number of its own; the log has the newest one of each tick.
  const auto inputs = read->inputs().value();
  int readings = 0;
  for (std::size_t i = 1; i < inputs.size(); ++i) readings += inputs[i].input.sequence != inputs[i - 1].input.sequence;
  CHECK(readings > 1.5 * summary["screens"][0]["frames"].get<double>());
}

TEST_CASE("a world that waits for its driver can be left") {
  const TemporaryFolder folder;
  const XDisplay display;
  write_text(folder / "small.toml", small_rig(1, "", "source = \"keyboard\""));
  const fs::path out = folder / "out", log = folder / "err";
  auto drive = start("septet", {"drive", "--rig", (folder / "small.toml").string(), "--out", out.string()}, log,
                     display.environment());
  REQUIRE(becomes_true([&] { return says(log, "screen a shows tick 0"); }));
  display.press_escape("Septet a");
  INFO(text_of(log));
  CHECK(exit_code(drive) == 3);
  CHECK(nlohmann::json::parse(text_of(out / "summary.json"))["ended"] == "escape");
  CHECK(fs::exists(out / "report.html"));
}

TEST_CASE("a drive that its driver begins again waits for him anew, and its operator's page keeps its address") {
  const TemporaryFolder folder;
  const XDisplay display;
  write_text(folder / "small.toml", small_rig(1, "", "source = \"keyboard\""));
  const fs::path out = folder / "out", log = folder / "err";
  auto drive =
      start("septet", {"drive", "--rig", (folder / "small.toml").string(), "--out", out.string(), "--page", "0"}, log,
            display.environment());
  const auto becomes = [&](const std::string& words) {
    return becomes_true([&] { return drive.poll() || says(log, words); });
  };
  REQUIRE(becomes("screen a shows tick 0"));
  display.tap_arrow_up("Septet a");
  REQUIRE(becomes("the driver took the controls"));
  display.press_escape("Septet a");
  REQUIRE(becomes("paused by the driver"));
  display.press_r("Septet a");
  REQUIRE(becomes("The drive begins again."));
  REQUIRE(becomes_true([&] { return drive.poll() || each_after("screen a shows tick 0", log).size() == 2; }));
  INFO(text_of(log));
  const auto pages = each_after("operator's page: ", log);
  REQUIRE(pages.size() == 2);
  CHECK(pages[0] == pages[1]);
  CHECK(pages[0].find("/#") != std::string::npos);
  display.press_escape("Septet a");
  CHECK(exit_code(drive) == 3);
  CHECK(nlohmann::json::parse(text_of(out / "summary.json"))["ended"] == "escape");
}

TEST_CASE("told to start now a drive waits for nobody and a full screen covers its monitor") {
  const TemporaryFolder folder;
  const XDisplay display;
  write_text(folder / "small.toml", small_rig(1, "", "source = \"keyboard\""));
  const fs::path out = folder / "out", log = folder / "err";
  auto drive =
      start("septet",
            {"drive", "--start-now", "--full-screen", "--rig", (folder / "small.toml").string(), "--out", out.string()},
            log, display.environment());
  const bool shows = becomes_true([&] { return newest_picture(out / "screens" / "a") > 0; });
  INFO(text_of(log));
  REQUIRE(shows);
  CHECK_FALSE(says(log, "waits for the driver"));
  CHECK(display.place_of("Septet a") == std::array{0, 0, 640, 480});
  drive.send_signal(SIGINT);
  CHECK(exit_code(drive) == 3);
}

TEST_CASE("a monitor of the rig that is not there is named by the screen that should cover it") {
  const TemporaryFolder folder;
  const XDisplay display;
  std::string rig = small_rig(1, "", "source = \"keyboard\"");
  rig += "monitor = 7\nfull_screen = true\n";
  write_text(folder / "small.toml", rig);
  const Ended driven =
      run("septet", {"drive", "--rig", (folder / "small.toml").string(), "--out", (folder / "out").string()},
          folder / "err", display.environment());
  INFO(driven.error);
  CHECK(driven.code == 1);
  CHECK(driven.error.find("none with index 7") != std::string::npos);
}

TEST_CASE("a rig for a keyboard is driven by the simulated driver where there is no window") {
  const TemporaryFolder folder;
  const Ended driven =
      run("septet",
          {"drive", "--no-screens", "--seconds", "1", "--rig", "three-monitors", "--out", (folder / "out").string()},
          folder / "err");
  INFO(driven.error);
  REQUIRE(driven.code == 0);
  CHECK(driven.error.find("the rig's car is not plugged in: a keyboard drives") != std::string::npos);
  CHECK(driven.error.find("the simulated driver drives") != std::string::npos);
  const auto log = logging::SessionReader::open(folder / "out" / "session.sqlite");
  REQUIRE(log.has_value());
  double pressed = 0.0;
  const auto inputs = log->inputs().value();
  for (const auto& input : inputs) pressed = std::max({pressed, input.input.accelerator, input.input.brake});
  CHECK(pressed > 0.0);
}

}  // namespace septet::pipeline
