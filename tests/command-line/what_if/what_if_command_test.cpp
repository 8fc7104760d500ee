#include "command-line/command/what_if_command.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "command-line/command/what_if_variants.hpp"
#include "tests/command-line/what_if/logged_crash.hpp"
#include "tests/why_not.hpp"

namespace septet::server {
namespace {

std::string text_in(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

}  // namespace

TEST_CASE("one change is told in a sentence, and lies as a table and a session beside the drive") {
  const LoggedCrash crash;
  std::ostringstream out;
  const auto done = run_what_if({.session = crash.session, .changes = {"brake:-0.5s"}, .run = {}, .out = {}}, out);
  REQUIRE_MESSAGE(done.has_value(), why_not(done));
  const auto said = lines_of(out.str());
  REQUIRE(said.size() == 4);
  CHECK(says(said[0], "ticks run again from 10 s without a change: every state hash agrees"));
  CHECK(says(said[1], "as logged: hit 3 parked (van) at "));
  CHECK(says(said[2], "brake:-0.5s: stopped at "));
  CHECK(says(said[2], " m before 3 parked (van)"));
  CHECK(std::filesystem::exists(crash.folder.path() / "what-if" / "what-if.sqlite"));
  const auto rows = lines_of(text_in(crash.folder.path() / "what-if" / "what-if.csv"));
  REQUIRE(rows.size() == 3);
  CHECK(rows[1].starts_with("logged,,,1,3 parked (van),"));
  CHECK(rows[2].starts_with("1,brake:-0.5s,,0,,,,,"));
}

TEST_CASE("a range is a table, a plot and the share that collides, the same however many run at once") {
  const LoggedCrash crash;
  std::vector<std::string> tables;
  for (const unsigned jobs : {1u, 3u}) {
    std::ostringstream out;
    const auto folder = crash.folder / ("jobs-" + std::to_string(jobs));
    const auto done = run_what_if({.session = crash.session,
                                   .changes = {"brake:-0.6s..0s/13"},
                                   .run = {.seconds = 4.0},
                                   .out = folder,
                                   .jobs = jobs},
                                  out);
    REQUIRE_MESSAGE(done.has_value(), why_not(done));
    CHECK(says(out.str(), " of 13 variants collide"));
    CHECK(says(out.str(), "; none from brake:-0.6s to brake:-"));
    tables.push_back(text_in(folder / "what-if.csv"));
    CHECK(says(text_in(folder / "what-if.svg"), "Closing speed of the collision"));
  }
  REQUIRE(lines_of(tables[0]).size() == 15);
  CHECK(tables[0] == tables[1]);
  // The later the braking, the harder the collision.
  double last_mps = 0.0;
  for (const auto& row : lines_of(tables[0])) {
    if (!says(row, ",1,3 parked (van),") || row.starts_with("logged")) continue;
    std::istringstream cells(row);
    std::string cell;
    for (int i = 0; i < 7; ++i) std::getline(cells, cell, ',');
    CHECK(std::stod(cell) > last_mps);
    last_mps = std::stod(cell);
  }
  CHECK(last_mps > 1.0);
}

TEST_CASE("no variant of a range is run where its table could not be written") {
  const LoggedCrash crash;
  std::ostringstream out;
  const auto done = run_what_if({.session = crash.session,
                                 .changes = {"brake:-0.6s..0s/13"},
                                 .run = {.seconds = 4.0},
                                 .out = crash.session / "what-if",
                                 .jobs = 1},
                                out);
  REQUIRE_FALSE(done.has_value());
  CHECK(says(describe(done.error()), "choose a folder that can be written"));
  CHECK(says(out.str(), "every state hash agrees"));
  CHECK_FALSE(says(out.str(), "variants a minute"));
}

TEST_CASE("wrong changes and sessions are refused in a line, and nothing is written") {
  const LoggedCrash crash;
  const auto refusal = [&](const std::vector<std::string>& changes, const std::filesystem::path& session) {
    std::ostringstream out;
    const auto done = run_what_if({.session = session, .changes = changes, .run = {}, .out = {}}, out);
    return done ? "taken" : describe(done.error());
  };
  CHECK(says(refusal({"horn:-1s"}, crash.session), "there is no input \"horn\""));
  CHECK(says(refusal({"brake:-1s..0s/9", "brake:x1..2/9"}, crash.session), "two ranges are given"));
  CHECK(says(refusal({"brake:-13s"}, crash.session), "would begin before the session does"));
  CHECK(says(refusal({"brake:-0.5s"}, crash.folder / "none.sqlite"), "none.sqlite"));
  CHECK_FALSE(std::filesystem::exists(crash.folder.path() / "what-if"));
}

TEST_CASE("an outcome that comes from another program is the one that was sent") {
  const VariantOutcome outcome{
      .collision =
          MetCollision{.tick = 77, .other = 3, .with = "3 parked (van)", .closing_speed_mps = 9.5, .delta_v_mps = 4.0},
      .stopped_s = 12.5,
      .least_gap_m = 0.25,
      .before_place_m = {},
      .last_tick = 1500,
      .state_hash = 0x123456789abcdef0};
  Bytes bytes;
  put_outcome(outcome, bytes);
  put_outcome({.last_tick = 4}, bytes);
  ByteReader reader(bytes);
  CHECK(get_outcome(reader) == outcome);
  CHECK(get_outcome(reader) == VariantOutcome{.last_tick = 4});
  CHECK(reader.ok());
  CHECK(reader.remaining() == 0);
  ByteReader cut{std::span(bytes).first(20)};
  get_outcome(cut);
  CHECK_FALSE(cut.ok());
}

}  // namespace septet::server
