#include "logging/session/participants.hpp"

#include <doctest/doctest.h>

#include "tests/logging/session_fixture.hpp"

namespace septet::logging {
namespace {

/// Remedy for a name that nobody has in a session with so many participants.
std::string choices_among(int participants) {
  const TemporaryFolder folder;
  auto writer = must_create(folder / "session.sqlite");
  for (Tick tick = 0; tick <= 10; ++tick) writer.record(taken(drive_snapshot(tick, participants)));
  REQUIRE(writer.finish().has_value());
  const auto stay = find_stay(must_open(folder / "session.sqlite"), "tram", "--of");
  REQUIRE_FALSE(stay.has_value());
  return stay.error().remedy;
}

}  // namespace

TEST_CASE("of many participants a dozen are named to choose from and the others counted") {
  const std::string all = choices_among(12);
  CHECK(all.find("12 (") != std::string::npos);
  CHECK(all.find("more") == std::string::npos);
  const std::string some = choices_among(15);
  CHECK(some.find("12 (") != std::string::npos);
  CHECK(some.find("13 (") == std::string::npos);
  CHECK(some.ends_with(" and 3 more"));
}

}  // namespace septet::logging
