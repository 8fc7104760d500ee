#include "command-line/command/session_participants.hpp"

#include <sstream>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "engine/document/json.hpp"
#include "tests/logging/session_fixture.hpp"
#include "tests/why_not.hpp"

namespace septet::server {
namespace {

/// A session in which a walker comes after 10 ticks and the driver's car and a lorry stay throughout, 30 ticks.
std::filesystem::path write_drive(const TemporaryFolder& folder, const std::string& names) {
  auto info = logging::example_info();
  info.other["participant_names"] = names;
  const auto file = folder / "session.sqlite";
  auto writer = logging::SessionWriter::create(file, info);
  REQUIRE_MESSAGE(writer.has_value(), why_not(writer));
  for (Tick tick = 0; tick <= 30; ++tick) {
    Snapshot world = logging::drive_snapshot(tick, tick < 10 ? 2 : 3);
    world.participants[1].model = *find_vehicle_model("lorry");
    if (tick >= 10) world.participants[2].model = *find_vehicle_model("pedestrian");
    writer->record(logging::taken(world));
  }
  REQUIRE(writer->finish().has_value());
  return file;
}

std::string listed(const std::filesystem::path& session, bool json) {
  std::ostringstream out;
  const auto done = run_session_participants({session, json}, out);
  REQUIRE_MESSAGE(done.has_value(), why_not(done));
  return out.str();
}

}  // namespace

TEST_CASE("the participants of a session are listed with name, kind, model and the time for which they are there") {
  const TemporaryFolder folder;
  const auto session = write_drive(folder, R"({"1": "ego", "3": "runner", "9": "never there"})");
  CHECK(listed(session, false) ==
        "number  name    kind        model       from s  to s\n"
        "     1  ego     car         volvo-s80     0.00  0.25  the driver's car\n"
        "     2  -       lorry       lorry         0.00  0.25\n"
        "     3  runner  pedestrian  pedestrian    0.08  0.25\n");
  const auto rows = document::Json::parse(listed(session, true));
  REQUIRE(rows.size() == 3);
  CHECK(rows[0].at("is_driver") == true);
  CHECK(rows[2].at("name") == "runner");
  CHECK(rows[2].at("kind") == "pedestrian");
  CHECK(rows[2].at("from_s").get<double>() == doctest::Approx(10.0 / 120.0));
  CHECK(rows[2].at("to_s").get<double>() == doctest::Approx(0.25));
}

TEST_CASE("a name with a terminal's control codes is listed harmless, and an altered row of names is refused") {
  const TemporaryFolder folder;
  CHECK(listed(write_drive(folder, R"({"1": "\u001b[2J"})"), false).find('\x1b') == std::string::npos);
  for (const char* altered : {"[1]", R"({"x": "ego"})", R"({"1": 2})", "{"}) {
    CAPTURE(altered);
    const TemporaryFolder other;
    std::ostringstream out;
    const auto done = run_session_participants({write_drive(other, altered), false}, out);
    REQUIRE_FALSE(done.has_value());
    CHECK(done.error().what.find("participant_names") != std::string::npos);
    CHECK(out.str().empty());
  }
}

TEST_CASE("a session without snapshots has no list, and the message says why") {
  const TemporaryFolder folder;
  auto writer = logging::must_create(folder / "session.sqlite");
  REQUIRE(writer.finish().has_value());
  std::ostringstream out;
  CHECK_FALSE(run_session_participants({folder / "session.sqlite", false}, out).has_value());
}

}  // namespace septet::server
