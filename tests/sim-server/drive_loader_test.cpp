#include "sim-server/drive/drive_loader.hpp"

#include <algorithm>
#include <string>

#include <doctest/doctest.h>

#include "tests/sim-server/shipped_drive.hpp"
#include "tests/why_not.hpp"

namespace septet::server {
namespace {

logging::SessionInfo session_of(const LoadedDrive& drive) {
  logging::SessionInfo session;
  session.files = drive.sources;
  session.seeds["drive"] = 1;
  session.other["traffic"] = "own";
  return session;
}

}  // namespace

TEST_CASE("a session's drive is loaded from the session, and a fault in what it holds is said to be of the session") {
  const LoadedDrive driven = shipped_drive("first-lesson", "desktop");
  const auto again = load_drive(session_of(driven), "s.sqlite");
  REQUIRE_MESSAGE(again.has_value(), why_not(again));
  CHECK(again->model->sources_hash == driven.model->sources_hash);
  for (const char* role : {"rig", "scenario", "road", "vehicle"}) {
    auto session = session_of(driven);
    const auto source = std::ranges::find(session.files, role, &logging::SourceFile::role);
    REQUIRE(source != session.files.end());
    source->content.resize(source->content.size() / 2);
    const auto damaged = load_drive(session, "s.sqlite");
    REQUIRE_FALSE(damaged.has_value());
    CHECK_MESSAGE(damaged.error().where.starts_with("s.sqlite, its file " + source->name), damaged.error().where);
    CHECK(damaged.error().remedy.find("unaltered copy") != std::string::npos);
    session.files.erase(source);
    const auto less = load_drive(session, "s.sqlite");
    REQUIRE_FALSE(less.has_value());
    CHECK(less.error().where == "s.sqlite");
  }
  auto session = session_of(driven);
  session.other["traffic"] = "horses";
  const auto drawn = load_drive(session, "s.sqlite");
  REQUIRE_FALSE(drawn.has_value());
  CHECK(describe(drawn.error()).starts_with("s.sqlite: there is no traffic engine \"horses\""));
}

}  // namespace septet::server
