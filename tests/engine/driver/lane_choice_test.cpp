// Gaps, the path across and the path back.

#include <cmath>

#include <doctest/doctest.h>

#include "engine/driver/lane_choice.hpp"

namespace septet::driver {
namespace {

constexpr double tick_s = 1.0 / 120.0;

SeenVehicle vehicle_in_lane(int lane, bool ahead, double gap_m, double speed_mps) {
  return {.id = 2,
          .lane = lane,
          .innermost_lane = lane,
          .outermost_lane = lane,
          .is_ahead = ahead,
          .gap_m = gap_m,
          .speed_mps = speed_mps};
}

/// A driver in the third lane on the path to the second.
struct Change {
  OwnPlace own;
  std::vector<SeenVehicle> vehicles;
  DriverParameters driver;
  MirrorState mirrors;
  LaneState state;
  Random random{1};

  Change() {
    own.lane = 3;
    own.speed_mps = 28.0;
    state.lane = 3;
    state.target = 2;
    state.phase = LanePhase::change;
    state.way = {.duration_s = driver.lanes.duration_s};
  }
  LaneScene scene() const { return {.own = own, .vehicles = vehicles, .desired_speed_mps = 30.0}; }
  void advance(double time_s) {
    for (double t = 0.0; t < time_s - 1e-9; t += tick_s)
      advance_lane_choice(state, driver, scene(), mirrors, std::nullopt, tick_s, random);
  }
};

}  // namespace

TEST_CASE("a change is safe with room and refused beside, before a faster one and behind a slower one") {
  Change change;
  const auto is_safe_with = [&](bool ahead, double gap_m, double speed_mps) {
    change.vehicles = {vehicle_in_lane(2, ahead, gap_m, speed_mps)};
    return is_safe(change.scene(), 2, change.driver);
  };
  CHECK(is_safe_with(false, 40.0, 28.0));
  CHECK(is_safe_with(false, 80.0, 33.0));
  CHECK_FALSE(is_safe_with(false, -3.0, 28.0));
  CHECK_FALSE(is_safe_with(false, 10.0, 33.6));
  CHECK_FALSE(is_safe_with(false, 14.0, 33.7));
  CHECK_FALSE(is_safe_with(false, 40.0, 38.0));
  CHECK(is_safe_with(true, 40.0, 28.0));
  CHECK(is_safe_with(true, 30.0, 33.0));
  CHECK_FALSE(is_safe_with(true, 13.0, 28.9));
  CHECK_FALSE(is_safe_with(true, 37.0, 20.0));
}

TEST_CASE("a gap that is accepted asks the driver for no more than gentle braking") {
  Change change;
  int accepted = 0;
  for (double gap_m = 2.0; gap_m < 120.0; gap_m += 1.0)
    for (double speed_mps = 10.0; speed_mps < 40.0; speed_mps += 1.0) {
      change.vehicles = {vehicle_in_lane(2, true, gap_m, speed_mps)};
      if (!is_safe(change.scene(), 2, change.driver)) continue;
      ++accepted;
      CHECK(wished_acceleration_mps2(change.driver.speed, change.own.speed_mps, 30.0, Obstacle{gap_m, speed_mps}) >
            -3.5);
    }
  CHECK(accepted > 500);
}

TEST_CASE("somebody who is about to come into the lane counts as being in it") {
  Change change;
  change.vehicles = {vehicle_in_lane(1, true, 5.0, 28.0)};
  CHECK(is_safe(change.scene(), 2, change.driver));
  change.vehicles[0].outermost_lane = 2;
  CHECK_FALSE(is_safe(change.scene(), 2, change.driver));
}

TEST_CASE("a change is given up for who comes from behind until the line is crossed, and not after it") {
  for (const bool crossed : {false, true}) {
    Change change;
    change.advance(1.5);
    REQUIRE(change.state.phase == LanePhase::change);
    if (crossed) change.own.lane = 2;
    change.vehicles = {vehicle_in_lane(2, false, 12.0, 34.0)};
    change.advance(tick_s);
    CHECK(change.state.phase == (crossed ? LanePhase::change : LanePhase::go_back));
    change.vehicles.clear();
    change.advance(change.driver.lanes.duration_s);
    CHECK(change.state.lane == (crossed ? 2 : 3));
    CHECK(change.state.target == change.state.lane);
    CHECK(change.state.phase == LanePhase::keep);
  }
}

TEST_CASE("the way across and back is one smooth line") {
  Change change;
  const auto across = [&] { return place_across(change.state, change.own.speed_mps, 0.0); };
  double before = 0.0, rate_before = 0.0, furthest = 0.0;
  for (int tick = 0; tick < 120 * 8; ++tick) {
    if (tick == 200) change.vehicles = {vehicle_in_lane(2, false, 5.0, 40.0)};
    change.advance(tick_s);
    const double rate = (across() - before) / tick_s;
    REQUIRE(std::abs(rate - rate_before) < 0.01);  // 0.01 of a lane per second in a tick: 4 m/s².
    furthest = std::max(furthest, across());
    before = across();
    rate_before = rate;
  }
  CHECK(furthest > 0.15);
  CHECK(furthest < 0.6);
  CHECK(across() == 0.0);
  CHECK(change.state.lane == 3);
}

TEST_CASE("a change ends at rest in the other lane and does not go on while the car stands") {
  Change change;
  change.advance(2.0);
  const double underway = place_across(change.state, change.own.speed_mps, 0.0);
  CHECK(underway > 0.2);
  change.own.speed_mps = 0.0;
  change.advance(20.0);
  CHECK(place_across(change.state, 0.0, 5.0) == doctest::Approx(underway));
  change.own.speed_mps = 28.0;
  const LaneWay& way = change.state.way;
  CHECK(point_on_way(way, way.duration_s).at == 1.0);
  CHECK(point_on_way(way, way.duration_s - 1e-6).rate_ps == doctest::Approx(0.0));
}

TEST_CASE("whoever is ahead in the lane that a change leaves is minded until the body has left it") {
  Change change;
  change.vehicles = {vehicle_in_lane(3, true, 12.0, 15.0)};
  const auto minded = [&] { return obstacle_on_way(change.state, change.scene(), change.driver.speed); };
  CHECK(minded());
  change.own.lane = 2;
  change.own.room_right_m = -0.3;
  CHECK(minded());
  change.own.room_right_m = 0.1;
  CHECK_FALSE(minded());
  // Back again: the leader in the target lane counts.
  change.state.phase = LanePhase::go_back;
  CHECK(minded());
}

TEST_CASE("an ambulance in another lane is stayed behind without hard braking") {
  Change change;
  SeenVehicle ambulance = vehicle_in_lane(2, true, 0.3, 20.0);
  ambulance.is_ambulance = true;
  change.vehicles = {ambulance};
  const auto wish_in = [&](int lane) {
    return wished_acceleration_mps2(change.driver.speed, 28.0, 30.0,
                                    obstacle_in_lane(change.scene(), lane, change.driver.speed));
  };
  CHECK(wish_in(2) < -8.0);
  CHECK(wish_in(3) == doctest::Approx(-change.driver.speed.braking_mps2));
}

}  // namespace septet::driver
