/// A session run again with a change of its driver's inputs.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "logging/session/session_reader.hpp"
#include "logging/session/sqlite_database.hpp"
#include "logging/session/whole_session.hpp"
#include "sim-server/drive/what_if/braking_earlier.hpp"
#include "sim-server/drive/what_if/variant.hpp"
#include "sim-server/drive/what_if/variant_session.hpp"
#include "tests/command-line/what_if/logged_crash.hpp"

namespace septet::server {
namespace {

InputChange change(const std::string& text) {
  const auto range = parse_change(text);
  REQUIRE_MESSAGE(range.has_value(), why_not(range));
  return range->first;
}

std::string refusal_of(const std::string& text) {
  const auto range = parse_change(text);
  return range ? "taken" : describe(range.error());
}

Expected<WhatIf> prepared(const logging::SessionReader& session, const std::vector<InputChange>& changes,
                          const WhatIfOptions& options = {}) {
  const std::vector<std::vector<InputChange>> extremes{changes};
  return prepare_what_if(session, extremes, options);
}

logging::SessionReader opened(const std::filesystem::path& file) {
  auto session = logging::SessionReader::open(file);
  REQUIRE_MESSAGE(session.has_value(), why_not(session));
  return std::move(*session);
}

/// Ticks 1 to 400 of a driver who accelerates until tick 200 and brakes, ever harder, from tick 241 on.
std::vector<logging::InputRecord> braking_at_241() {
  std::vector<logging::InputRecord> records;
  for (Tick tick = 1; tick <= 400; ++tick)
    records.push_back({.tick = tick,
                       .report = {},
                       .input = {.steering_wheel_rad = 0.001 * static_cast<double>(tick),
                                 .accelerator = tick <= 200 ? 0.3 : 0.0,
                                 .brake = tick >= 241 ? 0.002 * static_cast<double>(tick - 200) : 0.0}});
  return records;
}

}  // namespace

TEST_CASE("a change is read from its text and written to the same; a wrong one is refused by its fault") {
  for (const char* text : {"brake:-0.5s", "brake:+0.25s@12.3s", "accelerator:x1.5", "clutch:=1@3s",
                           "steering_wheel_rad:-0.1s@9s", "steering_wheel_rad:=-0.2@9s"}) {
    CAPTURE(text);
    CHECK(text_of(change(text)) == text);
  }
  const auto range = parse_change("brake:-1s..0s/5");
  REQUIRE(range.has_value());
  REQUIRE(range->count == 5);
  const auto factors = parse_change("brake:x1..2/3");
  REQUIRE_MESSAGE(factors.has_value(), why_not(factors));
  CHECK(change_at(*factors, 1).value == 1.5);
  CHECK(change_at(*range, 0).value == -1.0);
  CHECK(change_at(*range, 1).value == -0.75);
  CHECK(change_at(*range, 4).value == 0.0);
  CHECK(says(refusal_of("horn:-1s"), "there is no input \"horn\""));
  CHECK(says(refusal_of("horn:-1s"), "brake, accelerator, clutch, steering_wheel_rad"));
  CHECK(says(refusal_of("brake"), "the change is missing"));
  CHECK(says(refusal_of("brake:-0.5"), "there is no number of seconds"));
  CHECK(says(refusal_of("brake:-0.5sx"), "\"x\" is left over"));
  CHECK(says(refusal_of("brake:-90s"), "more than 60 s"));
  CHECK(says(refusal_of("brake:xnan"), "there is no number"));
  CHECK(says(refusal_of("brake:x-1"), "the factor -1"));
  CHECK(says(refusal_of("brake:=1.2@3s"), "brake lies between 0 and 1; 1.2 does not"));
  CHECK(says(refusal_of("brake:=0.5"), "the instant is missing"));
  CHECK(says(refusal_of("steering_wheel_rad:-0.5s"), "the instant is missing"));
  CHECK(says(refusal_of("brake:-1s..0s"), "a range is FIRST..LAST/COUNT"));
  CHECK(says(refusal_of("brake:-1s..0s/1"), "2 to 1000000 variants"));
  CHECK(says(refusal_of("brake:-1s..0s/2.5"), "2 to 1000000 variants"));
}

TEST_CASE("a shift moves the pedal by exactly its ticks, and leaves the other inputs") {
  const auto records = braking_at_241();
  const KnownInputs known{records, 400};
  const auto logged = [&](Tick tick) { return records[std::min<Tick>(tick, 400) - 1].input; };
  for (const int by : {-60, -1, 0, 7}) {
    CAPTURE(by);
    const auto placed = place_change(change(fmt::format("brake:{:+}s", by / 120.0)), known, "session");
    REQUIRE_MESSAGE(placed.has_value(), why_not(placed));
    CHECK(placed->from == 241);
    CHECK(placed->by == by);
    CHECK(placed->first == static_cast<Tick>(241 + std::min(by, 0)));
    for (Tick tick = 1; tick <= 380; ++tick) {
      const DriverInput input = changed_input(known, {&*placed, 1}, tick);
      const int from = static_cast<int>(tick) - by;
      CHECK(input.brake == (from >= 241 ? logged(static_cast<Tick>(from)).brake : 0.0));
      CHECK(input.steering_wheel_rad == logged(tick).steering_wheel_rad);
      // One foot: it leaves the accelerator where it brakes and did not.
      CHECK(input.accelerator == (from >= 241 && tick <= 200 ? 0.0 : logged(tick).accelerator));
    }
  }
}

TEST_CASE("what the driver did after the collision does not come back earlier") {
  auto records = braking_at_241();
  for (Tick tick = 301; tick <= 400; ++tick) records[tick - 1].input.brake = 0.0;  // Hit at 300, and let go.
  const KnownInputs known{records, 300};
  const auto placed = place_change(change("brake:-0.5s"), known, "session");
  REQUIRE(placed.has_value());
  const double at_collision = records[299].input.brake;
  for (const Tick tick : {240, 260, 300, 399, 5000})
    CHECK(changed_input(known, {&*placed, 1}, tick).brake == at_collision);
  CHECK(changed_input(known, {&*placed, 1}, 5000).steering_wheel_rad == records[299].input.steering_wheel_rad);
  CHECK(changed_input(known, {}, 301).brake == 0.0);
}

TEST_CASE("a scaled pedal stays within its travel, and a set one holds its value") {
  const auto records = braking_at_241();
  const KnownInputs known{records, 400};
  const auto scaled = place_change(change("brake:x4"), known, "session");
  REQUIRE(scaled.has_value());
  CHECK(changed_input(known, {&*scaled, 1}, 240).brake == 0.0);
  CHECK(changed_input(known, {&*scaled, 1}, 250).brake == doctest::Approx(0.4));
  CHECK(changed_input(known, {&*scaled, 1}, 400).brake == 1.0);
  const auto set = place_change(change("steering_wheel_rad:=0.5@2s"), known, "session");
  REQUIRE(set.has_value());
  CHECK(changed_input(known, {&*set, 1}, 239).steering_wheel_rad == records[238].input.steering_wheel_rad);
  CHECK(changed_input(known, {&*set, 1}, 240).steering_wheel_rad == 0.5);
}

TEST_CASE("a change without a place in the log is refused by its reason") {
  const auto records = braking_at_241();
  const auto refusal = [&](const std::string& text, Tick until) {
    const auto placed = place_change(change(text), {records, until}, "session");
    return placed ? "taken" : describe(placed.error());
  };
  CHECK(says(refusal("brake:-0.5s", 240), "the brake was not pressed in the 10 s before 2.00 s"));
  CHECK(says(refusal("clutch:x2", 400), "the clutch was not pressed"));
  CHECK(says(refusal("brake:-2.1s", 400), "would begin before the session does"));
  CHECK(says(refusal("brake:=1@3s", 300), "lies outside of what was driven"));
}

TEST_CASE("without a change every tick has the logged state hash, from a kept state on too") {
  const LoggedCrash crash;
  const auto session = opened(crash.session);
  const auto all = prepared(session, {}, {.seconds = 60.0});
  REQUIRE_MESSAGE(all.has_value(), why_not(all));
  CHECK(all->begin == 0);
  CHECK(all->agreeing_ticks == LoggedCrash::last_tick);
  const auto later = prepared(session, {change("brake:+0s")}, {.seconds = 60.0});
  REQUIRE_MESSAGE(later.has_value(), why_not(later));
  CHECK(later->begin == 1200);
  CHECK(later->fork == LoggedCrash::brake_tick - 1);
  CHECK(later->agreeing_ticks == LoggedCrash::last_tick - 1200);
  REQUIRE(later->logged.has_value());
  CHECK(later->logged->met.with == "3 parked (van)");
  // A shift by nothing is the logged drive, to the collision.
  const auto same = run_variant(*later, std::vector{change("brake:+0s")});
  REQUIRE_MESSAGE(same.has_value(), why_not(same));
  REQUIRE(same->collision.has_value());
  CHECK(*same->collision == later->logged->met);
  CHECK(*same->least_gap_m == 0.0);
  // What is passed over in the logged drive is in a variant as well.
  const auto passed = prepared(session, {change("brake:+0s")},
                               {.from_s = static_cast<double>(same->collision->tick) / 120.0 + 0.2, .seconds = 60.0});
  REQUIRE_MESSAGE(passed.has_value(), why_not(passed));
  CHECK_FALSE(passed->logged.has_value());
  const auto on = run_variant(*passed, std::vector{change("brake:+0s")});
  REQUIRE_MESSAGE(on.has_value(), why_not(on));
  CHECK_FALSE(on->collision.has_value());
}

TEST_CASE(
    "half a second earlier the car stops before the van, by the way of half a second less the rest of its braking") {
  const LoggedCrash crash;
  const auto session = opened(crash.session);
  const std::vector<InputChange> earlier{change("brake:-0.5s")};
  const auto what_if = prepared(session, earlier);
  REQUIRE_MESSAGE(what_if.has_value(), why_not(what_if));
  const auto outcome = run_variant(*what_if, earlier);
  REQUIRE_MESSAGE(outcome.has_value(), why_not(outcome));
  CHECK_FALSE(outcome->collision.has_value());
  REQUIRE(outcome->stopped_s.has_value());
  REQUIRE(outcome->least_gap_m.has_value());

  // The variant's session tells its deceleration, the logged one its speeds.
  const auto file = write_variant_session(session, *what_if, earlier, crash.folder / "what-if");
  REQUIRE_MESSAGE(file.has_value(), why_not(file));
  const auto variant = opened(*file);
  const auto samples = variant.samples(), logged = session.samples();
  REQUIRE(samples.has_value());
  REQUIRE(logged.has_value());
  const auto at = [&](double time_s) { return (*logged)[static_cast<std::size_t>(std::lround(10.0 * time_s))]; };
  const double half_second_m = at(11.5).x_m - at(11.0).x_m;
  const double collision_mps = what_if->logged->met.closing_speed_mps;
  const auto slow = std::ranges::find_if(*samples, [&](const logging::Sample& sample) {
    return sample.simulated_time_s > 11.5 && sample.speed_mps < collision_mps;
  });
  REQUIRE(slow != samples->end());
  const auto stood =
      std::ranges::find_if(slow, samples->end(), [](const logging::Sample& sample) { return sample.speed_mps < 0.5; });
  REQUIRE(stood != samples->end());
  const double deceleration_mps2 =
      (slow->speed_mps - stood->speed_mps) / (stood->simulated_time_s - slow->simulated_time_s);
  const double rest_m = collision_mps * collision_mps / (2.0 * deceleration_mps2);
  CHECK(std::abs(*outcome->least_gap_m - (half_second_m - rest_m)) < 0.05);
  // In the tick of the collision the car lies in the van already, by a tick's way at most.
  CHECK(*outcome->before_place_m >= *outcome->least_gap_m);
  CHECK(*outcome->before_place_m - *outcome->least_gap_m < collision_mps / 120.0);
}

TEST_CASE("a variant is a whole session of its own, without the driver's code, and can be changed again") {
  const LoggedCrash crash;
  const auto session = opened(crash.session);
  const std::vector<InputChange> earlier{change("brake:-0.5s")};
  const auto what_if = prepared(session, earlier, {.seconds = 2.0});
  REQUIRE_MESSAGE(what_if.has_value(), why_not(what_if));
  const auto folder = crash.folder / "what-if";
  REQUIRE(write_variant_session(session, *what_if, earlier, folder).has_value());
  const auto file = write_variant_session(session, *what_if, earlier, folder);  // In the stead of the first.
  REQUIRE_MESSAGE(file.has_value(), why_not(file));
  const auto variant = opened(*file);
  const auto whole = logging::read_whole(variant, {});
  REQUIRE_MESSAGE(whole.has_value(), why_not(whole));
  CHECK(whole->has_digest);
  CHECK(variant.info().participant.empty());
  CHECK(variant.info().other.at("what_if_changes") == "brake:-0.5s");
  CHECK(variant.info().other.at("begun_at_tick") == "1200");
  CHECK(variant.info().other.at("what_if_source_started_utc") == session.info().started_utc);
  const auto events = variant.events();
  REQUIRE(events.has_value());
  const auto told = std::ranges::find(*events, "what_if", &logging::Event::kind);
  REQUIRE(told != events->end());
  CHECK(told->tick == what_if->fork);
  // Its inputs give its hashes again.
  const auto again = prepared(variant, {}, {.seconds = 60.0});
  REQUIRE_MESSAGE(again.has_value(), why_not(again));
  CHECK(again->agreeing_ticks == what_if->end - what_if->begin);

  std::filesystem::copy_file(crash.session, folder / "other.sqlite");
  std::filesystem::remove(*file);
  std::filesystem::rename(folder / "other.sqlite", *file);
  const auto refused = write_variant_session(session, *what_if, earlier, folder);
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().what == "this is no variant of a drive, and is not replaced");
}

TEST_CASE("a session whose inputs or hashes were changed has no variants") {
  const LoggedCrash crash;
  const auto change_row = [&](const std::string& sql) {
    auto database = logging::Database::open(crash.session, logging::OpenMode::change);
    REQUIRE(database.has_value());
    auto statement = database->prepare(sql);
    REQUIRE(statement.has_value());
    REQUIRE(statement->run().has_value());
  };
  const auto refusal = [&](const std::vector<InputChange>& changes = {}) {
    const auto what_if = prepared(opened(crash.session), changes, {.seconds = 60.0});
    return what_if ? "taken" : describe(what_if.error());
  };
  change_row("UPDATE driver_inputs SET brake = 0.61 WHERE tick = 1500");
  CHECK(says(refusal(), "without a change tick 1500 gives state hash"));
  CHECK(says(refusal(), "the session's driver inputs are not those that were driven with"));
  change_row("UPDATE driver_inputs SET brake = 0.6 WHERE tick = 1500");
  CHECK(refusal() == "taken");
  change_row("DELETE FROM driver_inputs WHERE tick = 700");
  CHECK(says(refusal(), "driver inputs are missing: the log has a gap"));
  change_row("DELETE FROM driver_inputs");
  CHECK(says(refusal(), "no driver inputs"));
}

TEST_CASE(
    "after a collision the debrief offers what half a second would have made of it, in the words of the same run") {
  const LoggedCrash crash;
  const auto session = opened(crash.session);
  const std::vector<InputChange> earlier{change("brake:-0.5s")};
  const auto what_if = prepared(session, earlier);
  REQUIRE_MESSAGE(what_if.has_value(), why_not(what_if));
  const auto outcome = run_variant(*what_if, earlier);
  REQUIRE_MESSAGE(outcome.has_value(), why_not(outcome));
  const auto offered = braking_earlier(session);
  REQUIRE_MESSAGE(offered.has_value(), why_not(offered));
  REQUIRE(offered->has_value());
  CHECK(**offered == fmt::format("Half a second earlier on the brake, and you would have stopped {:.1f} m before 3 "
                                 "parked (van).",
                                 *outcome->least_gap_m));
  // A drive without a collision is offered nothing.
  const LoggedCrash none(400.0);
  const auto nothing = braking_earlier(opened(none.session));
  REQUIRE_MESSAGE(nothing.has_value(), why_not(nothing));
  CHECK_FALSE(nothing->has_value());
}

}  // namespace septet::server
