#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "engine/control/control_message.hpp"
#include "engine/world/call.hpp"
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

TEST_CASE("a call is told by its own words, and the longest one fits into an event on the wire") {
  Call call{.name = "say", .node = "town house/1/2", .parameters = {{"text", "a b=c"}, {"x", ""}}, .by = "lab"};
  CHECK(values_of(call_event, text_of(call)) ==
        Values{{"name", "say"}, {"node", "town house/1/2"}, {"text", "a b=c"}, {"x", ""}, {"by", "lab"}});
  const auto told = told_on_page({.kind = std::string(call_event), .participant = {}, .detail = text_of(call)});
  REQUIRE(told.has_value());
  CHECK(told->text == "call: name say, node town house/1/2, text a b=c, x , by lab");
  const std::string longest(longest_call_value, 'v');
  call = {.name = std::string(longest_call_name, 'n'), .node = longest, .parameters = {}, .by = {}};
  for (std::size_t i = 0; i < most_call_parameters; ++i) {
    call.parameters.emplace_back("parameter_" + std::to_string(i), std::string(longest_call_value, 'v'));
    if (!read_call(text_of(call)).has_value()) call.parameters.back().second.resize(20);
  }
  REQUIRE(read_call(text_of(call)).has_value());
  call.by = longest;
  CHECK(text_of(call).size() > control::most_event_detail_bytes - 600);
  CHECK(text_of(call).size() <= control::most_event_detail_bytes);
}

}  // namespace septet::server
