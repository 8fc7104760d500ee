#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <doctest/doctest.h>

#include "command-line/command/past_sessions.hpp"
#include "tests/logging/session_fixture.hpp"

namespace septet::server {
namespace {

namespace fs = std::filesystem;

constexpr const char* lesson =
    "title = \"Our lesson\"\naim = \"Slowly\"\npass_mark = 6.0\nshortest_s = 0.1\n[[task]]\nid = \"speed\"\nsays = "
    "\"Not "
    "faster than 60 km/h\"\nmeasure = \"speed\"\nbound = 60.0\ntolerance = 20.0\n[[task]]\nid = \"stop\"\nsays = "
    "\"Stop\"\n"
    "measure = \"stop\"\nbound = 5.0\ntolerance = 5.0\n";

/// A drive of two seconds at this speed, a lesson where the rules are given, with these events.
void write_drive(const fs::path& folder, const std::string& started_utc, double speed_mps, const std::string& rules,
                 const std::string& game = "") {
  fs::create_directories(folder);
  logging::SessionInfo info = logging::example_info();
  info.started_utc = started_utc;
  info.other["note"] = "rain";
  if (!rules.empty()) info.files.push_back({"lesson", "ours.lesson.toml", rules});
  auto writer = logging::SessionWriter::create(folder / "session.sqlite", info);
  REQUIRE(writer.has_value());
  for (Tick tick = 0; tick < 24; ++tick) {
    logging::Sample sample;
    sample.tick = tick * 12;
    sample.simulated_time_s = 0.1 * static_cast<double>(tick);
    sample.speed_mps = speed_mps;
    sample.x_m = sample.simulated_time_s * speed_mps;
    writer->record(sample);
  }
  if (!game.empty())
    writer->record(
        logging::Event{.tick = 240, .simulated_time_s = 2.0, .kind = "game", .participant = {}, .detail = game});
  CHECK(writer->finish().has_value());
}

/// Waits until everything has been read.
FoundSessions all_of(PastSessions& past) {
  while (past.found().is_looking) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return past.found();
}

}  // namespace

TEST_CASE("a past drive has its lesson's mark, or its game's points, and what is no session is left out") {
  const TemporaryFolder folder;
  write_drive(folder / "slow", "2026-11-01T08:00:00Z", 10.0, lesson);
  write_drive(folder / "fast", "2026-11-02T08:00:00Z", 25.0, lesson);
  write_drive(folder / "game", "2026-11-03T08:00:00Z", 20.0, "",
              "state=over why=lost level=3 points=4520 survived_s=61.0");
  write_drive(folder / "wrong-rules", "2026-11-04T08:00:00Z", 20.0, "title = 7");
  write_drive(folder / "wrong-points", "2026-11-05T08:00:00Z", 20.0, "", "level=1e999 points=many");
  fs::create_directories(folder / "broken");
  std::ofstream(folder / "broken/session.sqlite") << "no session at all";
  PastSessions past(folder.path());
  past.look();
  const auto found = all_of(past);
  REQUIRE(found.sessions.size() == 5);
  REQUIRE(found.folders.size() == 5);
  const auto session = [&](const std::string& name) {
    const auto at = std::ranges::find(found.sessions, name, &page::PastSession::folder);
    REQUIRE(at != found.sessions.end());
    CHECK(found.folders[static_cast<std::size_t>(at - found.sessions.begin())] == folder / name);
    return *at;
  };
  CHECK(session("slow").lesson == "Our lesson");
  CHECK(session("slow").mark == doctest::Approx(10.0));
  CHECK(session("slow").is_passed);
  CHECK(session("slow").note == "rain");
  REQUIRE(session("slow").tasks.size() == 2);
  CHECK_FALSE(session("slow").tasks[1].mark.has_value());  // It never stood.
  CHECK(session("fast").mark == doctest::Approx(0.0));     // 90 km/h, 30 over.
  CHECK_FALSE(session("fast").is_passed);
  CHECK(session("fast").tasks[0].severity == "serious");
  CHECK(session("game").points == 4520.0);
  CHECK(session("game").level == 3);
  CHECK(session("game").lesson.empty());
  CHECK(session("wrong-rules").lesson.empty());
  CHECK_FALSE(session("wrong-points").points.has_value());
  CHECK(session("wrong-points").level == 0);
  CHECK(found.sessions.front().folder == "wrong-points");  // The newest first.
}

TEST_CASE("past drives are told of as they are read, and who looks waits for none of them") {
  const TemporaryFolder folder;
  for (int i = 0; i < 12; ++i)
    write_drive(folder / ("drive-" + std::to_string(i)), "2026-11-01T08:00:0" + std::to_string(i % 10) + "Z", 10.0,
                lesson);
  PastSessions past(folder.path());
  CHECK_FALSE(past.found().is_looking);
  past.look();
  std::size_t before = 0;
  while (true) {
    const auto found = past.found();
    CHECK(found.sessions.size() >= before);  // Listed sessions stay.
    before = found.sessions.size();
    if (!found.is_looking) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  CHECK(before == 12);
  CHECK(past.has_news());
  CHECK_FALSE(past.has_news());
  const auto first = past.found();
  write_drive(folder / "late", "2026-12-01T08:00:00Z", 10.0, lesson);
  fs::remove_all(folder / "drive-3");
  const fs::path changed = folder / "drive-4/session.sqlite";  // As an answer of its driver changes it.
  fs::last_write_time(changed, fs::last_write_time(changed) + std::chrono::seconds(2));
  past.look();
  while (past.found().is_looking) CHECK(past.found().sessions.size() >= 11);
  const auto second = past.found();
  CHECK(second.sessions.size() == 12);
  CHECK(second.sessions.front().folder == "late");
  for (const page::PastSession& session : second.sessions)
    if (const auto same = std::ranges::find(first.sessions, session.folder, &page::PastSession::folder);
        same != first.sessions.end())
      CHECK(same->id == session.id);  // A page that has the list asks for the same drive.
}

}  // namespace septet::server
