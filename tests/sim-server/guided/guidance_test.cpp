// What a driver is told on his way, and that it is kept with the state.

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/simulation/saved_state.hpp"
#include "engine/simulation/server_step.hpp"
#include "engine/world/guidance_words.hpp"
#include "tests/sim-server/guided/guided_drive.hpp"

namespace septet::server {
namespace {

/// The town without traffic, the car at its entry.
struct Entry {
  LoadedDrive loaded = shipped_drive("town", "desktop");
  simulation::State state = [&] {
    auto begun = simulation::initial_state(*loaded.model, traffic::own_traffic(loaded.model->roads, 1));
    REQUIRE(begun.has_value());
    return std::move(*begun);
  }();
  std::vector<simulation::Event> events;

  Expected<void> command(const std::string& text) {
    const auto parsed = simulation::parse_operator_command(text);
    REQUIRE_MESSAGE(parsed.has_value(), why_not(parsed));
    CHECK(simulation::text_of(*parsed) == text);
    return simulation::apply_operator_command(*loaded.model, *parsed, state, events);
  }
  bool was_told(const std::string& words) const {
    return std::ranges::any_of(events, [&](const simulation::Event& event) {
      return event.kind == "guidance" && event.detail.find(words) != std::string::npos;
    });
  }
  void roll(double seconds) {
    DriverInput input;
    input.accelerator = 0.2;
    for (int i = 0; i < static_cast<int>(120.0 * seconds); ++i)
      simulation::server_step(*loaded.model, input, state, events, {});
  }
};

}  // namespace

TEST_CASE("a turn is told early and again at it, and each word is an event and in the snapshot") {
  Entry entry;
  REQUIRE(entry.command("to Bahnhofsplatz").has_value());
  CHECK(entry.was_told("word=route length_m=700"));
  for (int i = 0; i < 60 && !entry.was_told("word=right when=now"); ++i) entry.roll(0.5);
  CHECK(entry.was_told("word=right when=soon in_m=1"));
  CHECK(entry.was_told("word=right when=now"));
  const auto guidance = guidance_of(simulation::capture_snapshot(*entry.loaded.model, entry.state));
  REQUIRE(guidance.has_value());
  CHECK(guidance->told == GuidanceWord{Guided::right, true, 0});
  CHECK(guidance->next.what == Guided::right);
  CHECK(guidance->to_next_m <= 60);
}

TEST_CASE("a car that leaves its route is told another one within a second") {
  Entry entry;
  REQUIRE(entry.command("to Bahnhofsplatz").has_value());
  REQUIRE(entry.command("traffic vehicles=0").has_value());
  entry.roll(1.0);
  entry.events.clear();
  // Past the turn, on the road straight on.
  REQUIRE(entry.command("put x_m=-600 y_m=-79 heading_rad=0 speed_mps=8").has_value());
  entry.roll(1.0);
  CHECK(entry.was_told("word=new_route"));
}

TEST_CASE("a goal that is nowhere, or that no lanes lead to, is refused and nothing has changed") {
  Entry entry;
  CHECK_FALSE(entry.command("to Atlantis").has_value());
  CHECK_FALSE(entry.state.guidance.has_value());
  CHECK_FALSE(entry.command("to nowhere").has_value());
  const auto before = simulation::hash_state(entry.state);
  REQUIRE(entry.command("to Nordring").has_value());
  CHECK(simulation::hash_state(entry.state) != before);
  REQUIRE(entry.command("to nowhere").has_value());
  CHECK(simulation::hash_state(entry.state) == before);
}

TEST_CASE("guidance is kept with the state, and goes on as it would have") {
  Entry entry;
  REQUIRE(entry.command("to Bahnhofsplatz").has_value());
  entry.roll(8.0);
  const auto kept = simulation::save_state(*entry.loaded.model, entry.state);
  REQUIRE(kept.has_value());
  auto again =
      simulation::restore_state(*entry.loaded.model, traffic::own_traffic(entry.loaded.model->roads, 1), *kept, "kept");
  REQUIRE_MESSAGE(again.has_value(), why_not(again));
  REQUIRE(again->guidance.has_value());
  CHECK(again->guidance->turns.size() == entry.state.guidance->turns.size());
  entry.roll(8.0);
  std::swap(entry.state, *again);
  entry.roll(8.0);
  CHECK(simulation::hash_state(entry.state) == simulation::hash_state(*again));
}

TEST_CASE("both effects of guidance come back from their bytes, and damaged ones are refused") {
  const Guidance guidance{{Guided::roundabout, false, 2}, 120, {Guided::left, true, 0}, 7, 12345};
  const auto read = decode_guidance(encode_guidance(guidance));
  REQUIRE(read.has_value());
  CHECK(*read == guidance);
  const GuidedRoute route{{{3, 0, -1, -2}, {70, 1, 2, 2}}, 12.34};
  const auto read_route = decode_guided_route(encode_guided_route(route));
  REQUIRE(read_route.has_value());
  CHECK(read_route->sections == route.sections);
  CHECK(read_route->ends_m == doctest::Approx(12.34));
  const auto is_refused = [](const Bytes& whole, const auto& decode) {
    for (std::size_t length = 0; length < whole.size(); ++length)
      if (decode(std::span(whole).first(length)).has_value()) return false;
    Bytes longer = whole;
    longer.push_back(std::byte{0});
    return !decode(std::span<const std::byte>(longer)).has_value();
  };
  CHECK(is_refused(encode_guidance(guidance), decode_guidance));
  CHECK(is_refused(encode_guided_route(route), decode_guided_route));
}

TEST_CASE("words are an instructor's in three languages, and an exit is counted in words") {
  CHECK(guidance_sentence({Guided::left, false, 0}, "en") == "At the next crossing, turn left.");
  CHECK(guidance_sentence({Guided::left, true, 0}, "de") == "Hier links abbiegen.");
  CHECK(guidance_sentence({Guided::roundabout, false, 2}, "en") == "At the roundabout, take the second exit.");
  CHECK(guidance_sentence({Guided::roundabout, true, 7}, "sv") == "Ta 7:e avfarten.");
  CHECK(guidance_sentence({Guided::arrive, true, 0}, "xx") == "You have arrived.");
  CHECK(guidance_arrow({{Guided::right, false, 0}, 50, {}, 0, 0}) == "▶ 50 m");
}

}  // namespace septet::server
