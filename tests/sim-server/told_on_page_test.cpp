#include <doctest/doctest.h>

#include "sim-server/drive/told_on_page.hpp"

namespace septet::server {
namespace {

using Values = std::vector<std::pair<std::string, std::string>>;

}  // namespace

TEST_CASE("the pairs of an event are told by name, and what a person wrote is told whole") {
  CHECK(values_of("kmh=80") == Values{{"kmh", "80"}});
  CHECK(values_of("tree closing_speed_mps=41.58") == Values{{"what", "tree"}, {"closing_speed_mps", "41.58"}});
  CHECK(values_of("by=Anna Berg note=speed=80 was too fast") ==
        Values{{"by", "Anna Berg"}, {"note", "speed=80 was too fast"}});
  CHECK(values_of("area=\"left mirror\" duration_s=0.4") == Values{{"area", "left mirror"}, {"duration_s", "0.4"}});
  CHECK(values_of("") == Values{});
  CHECK(values_of("= =") == Values{{"what", "= ="}});
}

TEST_CASE("what is no news to a person is not told, and an event nobody has words for has no pairs in its text") {
  CHECK_FALSE(
      told_on_page({.kind = "scenario", .participant = {}, .detail = "element=ring-3 state=running"}).has_value());
  const auto told =
      told_on_page({.simulated_time_s = 2.0, .kind = "some_thing", .participant = {}, .detail = "a_b=3 c=4"});
  REQUIRE(told.has_value());
  CHECK(told->text == "some thing: a b 3, c 4");
  CHECK(told->text.find('=') == std::string::npos);
  const auto said = told_on_page({.kind = "screen", .participant = {}, .detail = "screen ahead connected"});
  REQUIRE(said.has_value());
  CHECK(said->kind == "message");
  // A device's name may have a colon, and a sentence of another kind may only begin alike.
  const auto silent =
      told_on_page({.kind = "screen", .participant = {}, .detail = "no sound: hw:0: busy; wait; or not"});
  REQUIRE(silent.has_value());
  CHECK(silent->values == Values{{"device", "hw:0"}, {"why", "busy"}, {"remedy", "wait; or not"}});
  CHECK(told_on_page({.kind = "screen", .participant = {}, .detail = "no sound: x"})->kind == "message");
  CHECK(said->text == "screen ahead connected");
}

}  // namespace septet::server
