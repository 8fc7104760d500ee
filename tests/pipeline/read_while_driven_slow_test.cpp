// A reader of a session being written changes nothing, and learns that it is still growing.

#include <algorithm>
#include <csignal>
#include <string>
#include <vector>

#include "logging/session/session_reader.hpp"
#include "tests/pipeline/foreign_reader.hpp"
#include "tests/pipeline/process_rig.hpp"

namespace septet::pipeline {

TEST_CASE("an experiment loses nobody to those who have its sessions open") {
  const TemporaryFolder folder;
  write_text(folder / "e.toml",
             "seed = 5\n[[group]]\nname = \"a\"\nsubjects = 3\ndriver = \"plain\"\n"
             "[[part]]\nname = \"task\"\nscenario = \"rescue-lane\"\nseconds = 10.0\nparameters = { vehicles = 20 }\n");
  const auto session = [&](const char* subject) {
    return folder / "out/subjects" / subject / "task-01/session.sqlite";
  };
  const ForeignReader idle(session("P01"), Reading::idle), stuck(session("P02"), Reading::transaction),
      busy(session("P03"), Reading::coming_and_going, true);
  const auto ended =
      run("septet", {"experiment", (folder / "e.toml").string(), "--jobs", "1", "--out", (folder / "out").string()},
          folder / "log");
  CHECK_MESSAGE(ended.code == 0, ended.error);
  for (const ForeignReader* reader : {&idle, &stuck, &busy}) CHECK(reader->looks() > 0);
  const std::string table = text_of(folder / "out/subjects.csv");
  CHECK(std::count(table.begin(), table.end(), '\n') == 4);
  // None of it is driven again.
  const auto again =
      run("septet", {"experiment", (folder / "e.toml").string(), "--out", (folder / "out").string()}, folder / "2.log");
  CHECK(again.code == 0);
  CHECK(again.error.find("h driven in") == std::string::npos);
}

TEST_CASE("a drive that goes on is verified as far as it has come and that is said") {
  const TemporaryFolder folder;
  write_text(folder / "small.toml", small_rig(1));
  const fs::path session = folder / "out/session.sqlite";
  auto server =
      start("septet-server",
            {"--rig", (folder / "small.toml").string(), "--scenario", "rescue-lane", "--driver", "plain", "--parameter",
             "vehicles=20", "--keys", make_keys(folder / "keys", "a").string(), "--out", (folder / "out").string(),
             "--any-port", "--wait-for-screens", "0", "--start-now", "--seconds", "0"},
            folder / "err");
  REQUIRE(becomes_true([&] {
    if (server.poll()) return true;
    const auto reader = logging::SessionReader::open(session);
    return reader && reader->inputs().value_or(std::vector<logging::InputRecord>()).size() > 60;
  }));
  REQUIRE(!server.poll());
  auto verify = start("septet", {"replay", "--verify", session.string()}, folder / "verify.err");
  const auto first = verify.read_line(patience), second = verify.read_line(patience);
  CHECK(exit_code(verify) == 0);
  CHECK_MESSAGE(first.value_or("").find("every state hash agrees") != std::string::npos,
                text_of(folder / "verify.err"));
  CHECK(second.value_or("").starts_with("this drive goes on"));
  server.send_signal(SIGINT);
  CHECK(exit_code(server) == 3);
  auto whole = start("septet", {"replay", "--verify", session.string()}, folder / "verify.err");
  CHECK(whole.read_line(patience).has_value());
  while (const auto line = whole.read_line(patience)) CHECK_FALSE(line->starts_with("this drive goes on"));
  CHECK(exit_code(whole) == 0);

  // A second drive does not go where one lies, and says how it would.
  const auto refused =
      run("septet-server",
          {"--no-screens", "--keys", (folder / "keys").string(), "--seconds", "1", "--out", (folder / "out").string()},
          folder / "second.err");
  CHECK(refused.code == 1);
  CHECK_MESSAGE(refused.error.find("mv '" + (folder / "out").string() + "'") != std::string::npos, refused.error);
  CHECK_MESSAGE(refused.error.find("septet drive") != std::string::npos, refused.error);
}

}  // namespace septet::pipeline
