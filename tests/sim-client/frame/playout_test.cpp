#include "sim-client/frame/playout.hpp"

#include <doctest/doctest.h>

#include "sim-client/frame/effect_playout.hpp"

using namespace septet;
using namespace septet::frame;

namespace {

constexpr double played_tick_s = 1.0 / 120.0;

HistoryTick tick_at(Tick tick, double x_m = 0.0) {
  HistoryTick entry;
  entry.snapshot.tick = tick;
  entry.snapshot.simulated_time_s = static_cast<double>(tick) * played_tick_s;
  Participant car;
  car.id = 1;
  car.world_from_vehicle.position_m.x = x_m;
  entry.snapshot.participants = {car};
  return entry;
}

EffectKeyframe keyframe(std::uint32_t id, Tick tick) { return {id, 1, {}, tick}; }

}  // namespace

TEST_CASE("a frame shows its own instant less the offset that holds at that instant") {
  TickHistory history;
  CHECK_FALSE(playout_time_s(history, 600));
  HistoryTick entry = tick_at(1000);
  entry.header = {.published_s = 10.0, .offset_s = 2.0, .next_offset_s = 2.5, .next_from_s = 10.1};
  history.add(entry);
  CHECK(*playout_time_s(history, 600) == doctest::Approx(10.0 - 2.0));
  CHECK(*playout_time_s(history, 605) == doctest::Approx(605.0 / 60.0 - 2.0));
  CHECK(*playout_time_s(history, 606) == doctest::Approx(10.1 - 2.5));
  CHECK(*playout_time_s(history, 660) == doctest::Approx(11.0 - 2.5));
}

TEST_CASE("the frame at an instant is the one whose own instant is nearest") {
  CHECK(frame_number(10.0) == 600);
  CHECK(frame_number(10.0 + 0.4 / 60.0) == 600);
  CHECK(frame_number(10.0 + 0.6 / 60.0) == 601);
  CHECK(frame_number(10.0 - 0.4 / 60.0) == 600);
}

TEST_CASE("a world between two ticks is interpolated and counts as of the tick before") {
  TickHistory history;
  history.add(tick_at(10, 0.0));
  history.add(tick_at(12, 0.02));
  const PlayedOut shown = show(history, 11.5 * played_tick_s, played_tick_s);
  CHECK(shown.on_tick);
  CHECK(shown.tick == 11);  // Tick 11 never came: all screens agree on it all the same.
  CHECK(shown.snapshot.participants[0].world_from_vehicle.position_m.x > 0.01);
  CHECK(shown.snapshot.participants[0].world_from_vehicle.position_m.x < 0.02);
  CHECK(show(history, 10.0 * played_tick_s, played_tick_s).tick == 10);
  CHECK(show(history, 12.0 * played_tick_s - 1e-9, played_tick_s).tick == 12);  // Nearer to it than clocks can tell.
}

TEST_CASE("beyond the newest tick it is held and the frame does not count as one on its tick") {
  TickHistory history;
  history.add(tick_at(10, 0.0));
  history.add(tick_at(12, 3.0));
  const PlayedOut held = show(history, 14.0 * played_tick_s, played_tick_s);
  CHECK_FALSE(held.on_tick);
  CHECK(held.tick == 12);
  CHECK(held.snapshot.participants[0].world_from_vehicle.position_m.x == 3.0);
  CHECK(show(history, 12.0 * played_tick_s, played_tick_s).on_tick);
  CHECK_FALSE(show(history, 12.0 * played_tick_s + 1e-5, played_tick_s).on_tick);
}

TEST_CASE("a screen that has just joined shows the oldest tick that it has") {
  TickHistory history;
  history.add(tick_at(10, 7.0));
  const PlayedOut shown = show(history, 5.0 * played_tick_s, played_tick_s);
  CHECK_FALSE(shown.on_tick);
  CHECK(shown.tick == 10);
  CHECK(shown.snapshot.participants[0].world_from_vehicle.position_m.x == 7.0);
}

TEST_CASE("of an effect the keyframes around the instant are found however often ticks repeat them") {
  TickHistory history;
  // Keyframes of ticks 4, 12 and 20 are repeated until the next one comes; they are sent four ticks ahead of their
  // instant.
  for (Tick tick = 0; tick <= 22; ++tick) {
    HistoryTick entry = tick_at(tick);
    entry.snapshot.effects = {keyframe(7, tick < 8 ? 4 : tick < 16 ? 12 : 20)};
    history.add(entry);
  }
  const auto at = [&](double tick) { return effects_at(history, tick * played_tick_s, played_tick_s).at(0); };
  EffectMoment moment = at(15.0);
  REQUIRE(moment.before);
  REQUIRE(moment.after);
  REQUIRE(moment.earlier);
  CHECK(moment.earlier->tick == 4);
  CHECK(moment.before->tick == 12);
  CHECK(moment.after->tick == 20);
  CHECK(at(12.0).before->tick == 12);
  CHECK(at(11.9).before->tick == 4);
  CHECK(at(11.9).after->tick == 12);
  CHECK(at(11.9).earlier == nullptr);
  CHECK(at(3.0).before == nullptr);
  CHECK(at(3.0).after->tick == 4);
  moment = at(21.0);
  CHECK(moment.before->tick == 20);
  CHECK(moment.after == nullptr);
}

TEST_CASE("an effect that is gone is not shown and one that is new has nothing before it") {
  TickHistory history;
  for (Tick tick = 0; tick <= 10; ++tick) {
    HistoryTick entry = tick_at(tick);
    if (tick < 5) entry.snapshot.effects = {keyframe(1, 2)};
    if (tick >= 5) entry.snapshot.effects = {keyframe(2, 6)};
    history.add(entry);
  }
  CHECK(effects_at(TickHistory{}, 1.0, played_tick_s).empty());
  const auto moments = effects_at(history, 9.0 * played_tick_s, played_tick_s);
  REQUIRE(moments.size() == 1);
  CHECK(moments[0].before->id == 2);
  CHECK(moments[0].earlier == nullptr);
  CHECK(effects_at(history, 4.5 * played_tick_s, played_tick_s).at(0).before->id == 1);
  CHECK(effects_at(history, -1.0, played_tick_s).at(0).before == nullptr);  // Older than all that is kept.
}

TEST_CASE("an effect that was gone for a while is a new one when it is there again") {
  TickHistory history;
  for (Tick tick = 0; tick <= 12; ++tick) {
    HistoryTick entry = tick_at(tick);
    if (tick < 4) entry.snapshot.effects = {keyframe(1, 2)};
    if (tick >= 8) entry.snapshot.effects = {keyframe(1, 9)};
    history.add(entry);
  }
  const EffectMoment moment = effects_at(history, 10.0 * played_tick_s, played_tick_s).at(0);
  REQUIRE(moment.before);
  CHECK(moment.before->tick == 9);
  CHECK(moment.earlier == nullptr);
  CHECK(effects_at(history, 8.5 * played_tick_s, played_tick_s).at(0).before == nullptr);
}
