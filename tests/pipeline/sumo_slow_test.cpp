// Drives with --traffic sumo as people start them. Without SUMO on this machine they say so and pass.

#include <sqlite3.h>
#include <unistd.h>

#include <csignal>

#include "tests/checkout.hpp"
#include "tests/pipeline/process_rig.hpp"

namespace septet::pipeline {
namespace {

bool has_sumo() {
  if (fs::exists(fs::path(build_folder()) / "septet-sumo.so") && ::access("/usr/bin/sumo", X_OK) == 0) return true;
  MESSAGE("skipped: SUMO is not installed");
  return false;
}

/// This process' child named "sumo"; 0: no such process.
int sumo_of(int parent) {
  const std::string tasks = fmt::format("/proc/{0}/task/{0}/children", parent);
  std::ifstream children(tasks);
  for (int child = 0; children >> child;) {
    std::ifstream name(fmt::format("/proc/{}/comm", child));
    std::string text;
    if (std::getline(name, text) && text == "sumo") return child;
  }
  return 0;
}

/// 0 while there is no session, or none with its tables.
int snapshots_in(const fs::path& session) {
  sqlite3* database = nullptr;
  sqlite3_stmt* query = nullptr;
  int count = 0;
  if (sqlite3_open_v2(session.c_str(), &database, SQLITE_OPEN_READONLY, nullptr) == SQLITE_OK &&
      sqlite3_prepare_v2(database, "SELECT COUNT(*) FROM snapshots", -1, &query, nullptr) == SQLITE_OK &&
      sqlite3_step(query) == SQLITE_ROW)
    count = sqlite3_column_int(query, 0);
  sqlite3_finalize(query);
  sqlite3_close(database);
  return count;
}

}  // namespace

TEST_CASE("without SUMO one message says what to install and nothing is left behind") {
  const TemporaryFolder folder;
  const auto log = folder / "err";
  auto process = program::ChildProcess::start(
      {.program = build_folder() + "/septet",
       .arguments = {"drive", "--no-screens", "--seconds", "1", "--traffic", "sumo", "--out",
                     (folder / "out").string()},
       .environment = {{"SEPTET_DATA", source_folder()}, {"PATH", (folder / "empty").string()}},
       .log = log});
  REQUIRE(process.has_value());
  CHECK(exit_code(*process) == 1);
  const std::string error = text_of(log);
  INFO(error);
  CHECK(error.find("apt install sumo") != std::string::npos);
  CHECK(error.find("--traffic own") != std::string::npos);
  CHECK_FALSE(fs::exists(folder / "out"));
}

TEST_CASE("a drive with SUMO is the same drive when it is run again") {
  if (!has_sumo()) return;
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  const auto drive =
      run("septet", {"drive", "--no-screens", "--seconds", "4", "--traffic", "sumo", "--out", out.string()},
          folder / "err");
  INFO(drive.error);
  REQUIRE(drive.code == 0);
  CHECK(snapshots_in(out / "session.sqlite") == 4 * 120 + 1);
  const auto verified = run("septet", {"replay", "--verify", (out / "session.sqlite").string()}, folder / "verify.err");
  INFO(verified.error);
  CHECK(verified.code == 0);
}

TEST_CASE("a SUMO that is killed ends the drive with one message and the log is kept") {
  if (!has_sumo()) return;
  const TemporaryFolder folder;
  const fs::path out = folder / "out", keys = make_keys(folder / "keys", "");
  auto drive = start(
      "septet-server",
      {"--no-screens", "--seconds", "100000", "--traffic", "sumo", "--keys", keys.string(), "--out", out.string()},
      folder / "err");
  int sumo = 0;
  REQUIRE(becomes_true(
      [&] { return (sumo = sumo_of(drive.process_id())) != 0 && snapshots_in(out / "session.sqlite") > 1; }));
  REQUIRE(::kill(sumo, SIGKILL) == 0);
  CHECK(exit_code(drive) == 1);
  const std::string error = text_of(folder / "err");
  INFO(error);
  CHECK(error.find("SUMO has gone") != std::string::npos);
  CHECK(snapshots_in(out / "session.sqlite") > 1);
  CHECK(text_of(out / "summary.json").find("\"ended\": \"traffic_lost\"") != std::string::npos);
  CHECK(text_of(out / "report.html").find("SUMO has gone") != std::string::npos);
}

}  // namespace septet::pipeline
