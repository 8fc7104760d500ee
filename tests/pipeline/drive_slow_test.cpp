#include <regex>

#include <sqlite3.h>

#include "engine/scene/command_codec.hpp"
#include "engine/scene/resolve.hpp"
#include "logging/session/session_reader.hpp"
#include "tests/pipeline/process_rig.hpp"

namespace septet::pipeline {
namespace {

Ended drive(const TemporaryFolder& folder, const std::string& out, int seed) {
  write_text(folder / "small.toml", small_rig(2));
  return run("septet",
             {"drive", "--virtual", "--seconds", "2", "--rig", (folder / "small.toml").string(), "--seed",
              std::to_string(seed), "--out", (folder / out).string()},
             folder / (out + ".err"));
}

std::string state_hash(const fs::path& out) {
  const std::string summary = text_of(out / "summary.json");
  std::smatch found;
  REQUIRE(std::regex_search(summary, found, std::regex("\"state_hash\": \"([0-9a-f]{16})\"")));
  return found[1];
}

std::vector<int> numbers_of(const std::string& text, const std::string& key) {
  std::vector<int> numbers;
  const std::regex pattern("\"" + key + "\": ([0-9]+)");
  for (std::sregex_iterator i(text.begin(), text.end(), pattern), end; i != end; ++i)
    numbers.push_back(std::stoi((*i)[1]));
  return numbers;
}

void change(const fs::path& session, const std::string& statement) {
  sqlite3* database = nullptr;
  REQUIRE(sqlite3_open(session.c_str(), &database) == SQLITE_OK);
  CHECK(sqlite3_exec(database, statement.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
  CHECK(sqlite3_changes(database) == 1);
  sqlite3_close(database);
}

}  // namespace

TEST_CASE("a drive leaves its pictures and log and report and summary and does the same again for the same seed") {
  const TemporaryFolder folder;
  const Ended first = drive(folder, "first", 7);
  INFO(first.error);
  REQUIRE(first.code == 0);
  for (const char* file : {"panorama.png", "screens/a/120.png", "screens/a/240.png", "screens/b/120.png",
                           "screens/b/240.png", "session.sqlite", "report.html", "summary.json"}) {
    CAPTURE(file);
    CHECK(fs::file_size(folder / "first" / file) > 100);
  }
  CHECK_FALSE(fs::exists(folder / "first" / "screens" / "a" / "server-lost.png"));
  const std::string summary = text_of(folder / "first" / "summary.json");
  for (const char* key : {"scenario", "rig", "seed", "ticks", "simulated_s", "wall_s", "state_hash",
                          "lateral_position_m", "mean", "sd", "lane_changes", "screens", "name", "frames",
                          "frames_off_tick", "datagrams_lost", "datagrams_repaired", "frame_ms_p50", "frame_ms_p99"}) {
    CAPTURE(key);
    CHECK(summary.find("\"" + std::string(key) + "\":") != std::string::npos);
  }
  CHECK(numbers_of(summary, "ticks") == std::vector{240});
  CHECK(numbers_of(summary, "frames") == std::vector{30, 30});
  CHECK(numbers_of(summary, "frames_off_tick") == std::vector{0, 0});

  const Ended again = drive(folder, "again", 7);
  REQUIRE(again.code == 0);
  CHECK(state_hash(folder / "again") == state_hash(folder / "first"));
  for (const char* file : {"panorama.png", "screens/a/120.png", "screens/b/240.png"}) {
    CAPTURE(file);
    CHECK(text_of(folder / "again" / file) == text_of(folder / "first" / file));
  }
  const Ended other = drive(folder, "again", 8);
  REQUIRE(other.code == 0);
  CHECK(state_hash(folder / "again") != state_hash(folder / "first"));
  // The earlier drive in the folder was moved aside, whole.
  CHECK(state_hash(folder / "again.1") == state_hash(folder / "first"));
  CHECK(fs::exists(folder / "again.1" / "session.sqlite"));
}

TEST_CASE("a replay verifies every tick and refuses altered input and draws on another rig") {
  const TemporaryFolder folder;
  REQUIRE(drive(folder, "out", 3).code == 0);
  const fs::path session = folder / "out" / "session.sqlite";
  auto verify = start("septet", {"replay", "--verify", session.string()}, folder / "verify.err");
  const auto line = verify.read_line(patience);
  CHECK(exit_code(verify) == 0);
  REQUIRE(line.has_value());
  CHECK(*line == "240 ticks run again: every state hash agrees");

  write_text(folder / "other.toml", small_rig(3));
  const Ended shown = run("septet",
                          {"replay", session.string(), "--virtual", "--rig", (folder / "other.toml").string(), "--out",
                           (folder / "shown").string()},
                          folder / "shown.err");
  INFO(shown.error);
  CHECK(shown.code == 0);
  CHECK(fs::exists(folder / "shown" / "panorama.png"));
  CHECK(fs::exists(folder / "shown" / "screens" / "c" / "240.png"));

  // Where nothing is said, beside the session; never where the session would be moved away from under its readers.
  const Ended beside =
      run("septet",
          {"replay", session.string(), "--virtual", "--seconds", "0.1", "--rig", (folder / "other.toml").string()},
          folder / "beside.err");
  INFO(beside.error);
  CHECK(beside.code == 0);
  CHECK(fs::exists(folder / "out" / "replay" / "panorama.png"));
  check_refused(
      run("septet", {"replay", session.string(), "--virtual", "--out", (folder / "out").string()}, folder / "same.err"),
      {"lies in this folder", "--out"}, folder / "nothing");
  check_refused(
      run("septet", {"replay", (folder / "typo" / "session.sqlite").string(), "--virtual"}, folder / "typo.err"),
      {"typo/session.sqlite", "no such file"}, folder / "typo");
  check_refused(run("septet", {"replay", (folder / "out").string(), "--virtual"}, folder / "folder.err"),
                {"/out: ", "this is a folder"}, folder / "typo");
  CHECK(fs::exists(session));

  // One verdict, and the cause of it.
  const auto refuse = [&](const std::string& name, const std::string& statement,
                          const std::vector<std::string>& words) {
    const fs::path copy = folder / (name + ".sqlite");
    fs::copy_file(session, copy);
    change(copy, statement);
    CAPTURE(statement);
    auto again = start("septet", {"replay", "--verify", copy.string()}, folder / (name + ".err"));
    CHECK_FALSE(again.read_line(patience).has_value());
    check_refused({exit_code(again), text_of(folder / (name + ".err"))}, words, folder / "nothing");
  };
  refuse("altered", "UPDATE driver_inputs SET steering_wheel_rad = steering_wheel_rad + 0.2 WHERE tick = 100",
         {"tick 100 gives state hash", "driver inputs are not those"});
  refuse("horn", "UPDATE driver_inputs SET horn = 1 WHERE tick = 100", {"driver inputs are not those"});
  refuse("hash", "UPDATE snapshots SET state_hash = 5 WHERE tick = 100",
         {"tick 100 gives state hash", "hashes or files were altered"});
  refuse("build",
         "UPDATE snapshots SET state_hash = 5 WHERE tick = 100; UPDATE meta SET value = 'abcdef0' WHERE key = "
         "'git_revision'",
         {"tick 100 gives state hash", "another build", "abcdef0"});
  refuse("no-inputs", "DELETE FROM driver_inputs WHERE tick > 1; DELETE FROM driver_inputs", {"no driver inputs"});
  refuse("no-snapshots", "DELETE FROM snapshots WHERE tick > 0; DELETE FROM snapshots", {"no snapshots"});
  refuse("negative",
         "UPDATE driver_inputs SET tick = tick - 1000000 WHERE tick > 1; UPDATE driver_inputs SET tick = -1 WHERE tick "
         "= 1",
         {"no driver inputs"});
  refuse("late", "DELETE FROM snapshots WHERE tick = 0", {"tick 0 is missing", "gap"});
  refuse("input-gap", "DELETE FROM driver_inputs WHERE tick = 7", {"driver input of tick 7 is missing", "gap"});
  refuse("cut", "DELETE FROM driver_inputs WHERE tick = 240", {"driver input of tick 240 is missing"});
}

TEST_CASE("a replay verifies from the last state that the log has kept") {
  const TemporaryFolder folder;
  const fs::path session = folder / "out" / "session.sqlite";
  REQUIRE(
      run("septet", {"drive", "--no-screens", "--seconds", "12", "--out", (folder / "out").string()}, folder / "err")
          .code == 0);
  const auto verify = [&](const fs::path& file, const std::string& from_s) {
    auto again = start("septet", {"replay", "--verify", file.string(), "--from", from_s}, folder / "verify.err");
    const auto line = again.read_line(patience);
    return exit_code(again) == 0 ? line.value_or("") : text_of(folder / "verify.err");
  };
  CHECK(verify(session, "11.5") == "240 ticks run again from the state of 10 s: every state hash agrees");
  CHECK(verify(session, "9.9") == "1440 ticks run again: every state hash agrees");
  // Ticks before the state are not run again.
  change(session, "UPDATE snapshots SET state_hash = 5 WHERE tick = 600");
  CHECK(verify(session, "11.5") == "240 ticks run again from the state of 10 s: every state hash agrees");
  CHECK(verify(session, "0").find("tick 600 gives state hash") != std::string::npos);
  change(session, "UPDATE snapshots SET state_hash = 5 WHERE tick = 1300");
  CHECK(verify(session, "11.5").find("tick 1300 gives state hash") != std::string::npos);

  // A state that was altered is no place to begin; a session of an earlier build has none, and is run from its start.
  const fs::path damaged = folder / "damaged.sqlite";
  fs::copy_file(session, damaged);
  change(damaged, "UPDATE saved_states SET data = zeroblob(length(data))");
  CHECK(verify(damaged, "11.5").find("no saved state") != std::string::npos);
  change(damaged, "DROP TABLE saved_states; UPDATE snapshots SET state_hash = 5 WHERE tick = 600");
  CHECK(verify(damaged, "11.5").find("tick 600 gives state hash") != std::string::npos);
}

TEST_CASE("an input whose snapshot was not written any more is not counted as compared") {
  const TemporaryFolder folder;
  REQUIRE(drive(folder, "out", 3).code == 0);
  const fs::path session = folder / "out" / "session.sqlite";
  change(session, "DELETE FROM snapshots WHERE tick = 240");
  auto verify = start("septet", {"replay", "--verify", session.string()}, folder / "verify.err");
  CHECK(verify.read_line(patience) == "239 ticks run again: every state hash agrees");
  CHECK(exit_code(verify) == 0);
}

TEST_CASE("a drive without screens keeps the world that it was in") {
  const TemporaryFolder folder;
  const Ended driven =
      run("septet", {"drive", "--no-screens", "--seconds", "0.1", "--out", (folder / "out").string()}, folder / "err");
  INFO(driven.error);
  REQUIRE(driven.code == 0);
  const auto session = logging::SessionReader::open(folder / "out" / "session.sqlite");
  REQUIRE(session.has_value());
  const auto edits = session->scene_edits();
  REQUIRE(edits.has_value());
  scene::Store store;
  for (const auto& edit : *edits) {
    const auto command = scene::decode(edit.command);
    REQUIRE(command.has_value());
    REQUIRE(store.apply(*command).has_value());
  }
  CHECK(scene::resolve(store).instances.size() > 1000);  // Ten kilometres of motorway.
}

}  // namespace septet::pipeline
