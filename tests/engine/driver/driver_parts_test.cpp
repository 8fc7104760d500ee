#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "engine/driver/gears.hpp"
#include "engine/driver/mirrors.hpp"
#include "engine/driver/pedals.hpp"
#include "engine/driver/perception.hpp"
#include "engine/driver/steering.hpp"
#include "tests/relative.hpp"

namespace septet::driver {

TEST_CASE("the steering gains give the wanted frequency and damping at every speed") {
  const SteeringParameters steering;
  const CarKnowledge car;
  for (const double v : {8.0, 15.0, 28.0, 40.0}) {
    const auto gains = steering_gains(steering, car, v);
    const double yaw_gain = v / (car.wheelbase_m + car.understeer_radps2pm * v * v) / car.steering_ratio;
    CHECK(std::sqrt(v * yaw_gain * gains.near / steering.near_distance_m) ==
          doctest::Approx(steering.natural_frequency_radps));
    CHECK(yaw_gain * (gains.near + gains.far) ==
          doctest::Approx(2 * steering.damping * steering.natural_frequency_radps));
  }
}

TEST_CASE(
    "changes seen out of the corner of the eye are answered in part and the rest when the eyes are "
    "back") {
  SteeringParameters steering;
  steering.position_noise_m = steering.heading_noise_rad = 0.0;
  steering.delay_s = 0.0;
  steering.hand_lag_s = 1e-6;
  steering.integral_per_s = 0.0;
  const CarKnowledge car;
  SteeringState state;
  Random random(1);
  const auto steer = [&](double near_rad, bool sees_road, double now_s) {
    return advance_steering(state, steering, car, {near_rad, 0.0}, sees_road, 25.0, now_s, 0.01, random);
  };
  const double near_gain = steering_gains(steering, car, 25.0).near;
  steer(0.0, true, 0.01);
  CHECK(steer(0.02, false, 0.02) == doctest::Approx(steering.peripheral_share * 0.02 * near_gain));
  CHECK(steer(0.02, true, 0.03) == doctest::Approx(0.02 * near_gain));
}

TEST_CASE("who winds the wheel up slowly driving and back while he speeds up holds it straight") {
  SteeringParameters steering;
  steering.position_noise_m = steering.heading_noise_rad = steering.integral_per_s = 0.0;
  SteeringState state;
  Random random(1);
  constexpr double dt_s = 0.01, bend_s = 3.0, most_rad = 0.3;
  double hands_rad = 0.0, most_hands_rad = 0.0;
  for (int step = 0; step < 900; ++step) {
    const double t = dt_s * step;
    const double path_rad = most_rad * std::max(0.0, 1.0 - std::abs(t - bend_s) / bend_s);
    const double speed_mps = t < bend_s ? 6.0 : std::min(14.0, 6.0 + 2.0 * (t - bend_s));
    hands_rad =
        advance_steering(state, steering, CarKnowledge{}, {path_rad, path_rad}, true, speed_mps, t, dt_s, random);
    most_hands_rad = std::max(most_hands_rad, hands_rad);
  }
  CHECK(most_hands_rad > 1.0);
  CHECK(std::abs(hands_rad) < 0.02 * most_hands_rad);
}

TEST_CASE("what is seen acts after the delay") {
  ReactionDelay<int> eyes;
  CHECK(eyes.through(0.0, 1, 0.5) == 1);
  CHECK(eyes.through(0.4, 2, 0.5) == 1);
  CHECK(eyes.through(0.8, 3, 0.5) == 1);
  CHECK(eyes.through(0.9, 4, 0.5) == 2);
  CHECK(eyes.through(1.3, 5, 0.5) == 3);
}

TEST_CASE("a wandering error has the standard deviation and correlation time it was given") {
  Random random(9);
  WanderingError error;
  double squares = 0.0, products = 0.0, previous = 0.0;
  constexpr int count = 400000;
  for (int i = 0; i < count; ++i) {
    const double value = error.advance(0.3, 2.0, 0.1, random);
    squares += value * value;
    products += value * previous;
    previous = value;
  }
  CHECK(std::sqrt(squares / count) == relative(0.3, 0.03));
  CHECK(products / squares == relative(std::exp(-0.1 / 2.0), 0.01));
}

TEST_CASE("the wish is none at the desired speed and at the time gap") {
  const SpeedParameters speed;
  CHECK(wished_acceleration_mps2(speed, 30.0, 30.0, std::nullopt) == doctest::Approx(0.0));
  CHECK(wished_acceleration_mps2(speed, 0.0, 30.0, std::nullopt) == doctest::Approx(speed.acceleration_mps2));
  const double gap_m = speed.standstill_gap_m + 20.0 * speed.time_gap_s;
  CHECK(std::abs(wished_acceleration_mps2(speed, 20.0, 30.0, Obstacle{gap_m, 20.0})) < 1e-9);
}

TEST_CASE("at the wanted gap the wish passes from following to braking without a kink") {
  const SpeedParameters speed;
  const double v = 20.0, gap_m = wanted_gap_m(speed, v, v), step = 1e-4;
  const auto wish = [&](double tightness) {
    return wished_acceleration_mps2(speed, v, 30.0, Obstacle{gap_m / tightness, v});
  };
  const double before = (wish(1.0) - wish(1.0 - step)) / step, after = (wish(1.0 + step) - wish(1.0)) / step;
  CHECK(before == relative(-2.0 * speed.acceleration_mps2, 1e-3));
  CHECK(after == relative(before, 1e-3));
}

TEST_CASE("between two gears the lever stands in neutral for half of its way") {
  GearParameters gears;
  CarKnowledge car;
  GearState state;
  state.started = true;
  state.phase = GearPhase::moving;
  state.clutch = 1.0;
  state.lever = 2;
  state.target = 3;
  double neutral_s = 0.0, whole_s = 0.0;
  while (state.phase == GearPhase::moving && whole_s < 10.0) {
    advance_gears(state, gears, car, {.engine_radps = 300.0, .speed_mps = 15.0, .gear = 2}, 0.001);
    whole_s += 0.001;
    if (state.lever == 0) neutral_s += 0.001;
  }
  CHECK(state.lever == 3);
  CHECK(neutral_s == relative(0.5 * gears.lever_s, 0.02));
}

TEST_CASE("a short gap to one who does not come nearer is opened gently, whoever cut in") {
  const SpeedParameters speed;
  for (const double gap_m : {2.0, 5.0, 13.0, 30.0})
    for (const double faster_mps : {0.0, 1.0, 4.0})
      CHECK(wished_acceleration_mps2(speed, 28.9, 30.0, Obstacle{gap_m, 28.9 + faster_mps}) > -2.2);
  CHECK(wished_acceleration_mps2(speed, 30.0, 33.0, Obstacle{37.0, 26.7}) > -2.5);
}

TEST_CASE("what stands in the way or brakes hard is braked for as hard as it takes") {
  const SpeedParameters speed;
  for (const double v : {10.0, 20.0, 30.0})
    for (const double needed_mps2 : {3.0, 4.5, 6.0}) {
      const double gap_m = v * v / (2.0 * needed_mps2);
      CHECK(wished_acceleration_mps2(speed, v, 33.0, Obstacle{gap_m, 0.0}) < -needed_mps2);
      CHECK(heuristic_acceleration_mps2(v, Obstacle{gap_m, 0.0}) == doctest::Approx(-needed_mps2));
    }
  const Obstacle steady{30.0, 25.0}, braking{30.0, 25.0, -6.0};
  CHECK(wished_acceleration_mps2(speed, 25.0, 33.0, braking) <
        wished_acceleration_mps2(speed, 25.0, 33.0, steady) - 0.5);
}

TEST_CASE("only an emergency moves the foot faster than comfort allows") {
  const SpeedParameters speed;
  OwnPlace own;
  own.speed_mps = 28.0;
  const auto largest_jerk_behind = [&](const Obstacle& obstacle) {
    PedalState pedals;
    Random random(2);
    double largest = 0.0, before = 0.0;
    for (int i = 0; i < 120 * 3; ++i) {
      advance_pedals(pedals, speed, {}, own, 30.0, obstacle, 1.0 / 120.0, random);
      largest = std::max(largest, std::abs(pedals.wish_mps2 - before) * 120.0);
      before = pedals.wish_mps2;
    }
    return largest;
  };
  CHECK(largest_jerk_behind({8.0, 28.0}) == doctest::Approx(speed.largest_jerk_mps3));
  CHECK(largest_jerk_behind({60.0, 0.0}) > 10.0);
}

TEST_CASE("accelerator and brake are never pressed together") {
  PedalState pedals;
  Random random(2);
  OwnPlace own;
  own.speed_mps = 25.0;
  bool braked = false, accelerated = false;
  for (int i = 0; i < 120 * 40; ++i) {
    const bool blocked = std::fmod(i / 120.0, 8.0) < 4.0;
    advance_pedals(pedals, {}, {}, own, 30.0, blocked ? std::optional(Obstacle{20.0, 18.0}) : std::nullopt, 1.0 / 120.0,
                   random);
    REQUIRE((pedals.accelerator == 0.0 || pedals.brake == 0.0));
    braked |= pedals.brake > 0.1;
    accelerated |= pedals.accelerator > 0.1;
  }
  CHECK(braked);
  CHECK(accelerated);
}

TEST_CASE("a glance turns the head to the mirror and back") {
  MirrorState mirrors;
  const MirrorParameters parameters;
  Random random(5);
  REQUIRE(begin_glance(mirrors, Mirror::right, parameters, random));
  CHECK_FALSE(begin_glance(mirrors, Mirror::left, parameters, random));
  CHECK_FALSE(sees_road(mirrors));
  double furthest = 0.0;
  std::optional<Mirror> looked;
  int ticks = 0;
  while (!looked && ++ticks < 1000) {
    looked = advance_mirrors(mirrors, parameters, false, 1.0 / 120.0, random);
    furthest = std::min(furthest, mirrors.head_rad);
  }
  CHECK(looked == Mirror::right);
  CHECK(furthest == doctest::Approx(head_heading_rad(Mirror::right)));
  CHECK(mirrors.head_rad == 0.0);
  CHECK(sees_road(mirrors));
}

TEST_CASE("the hand wheel for a bend is that of its geometry and of what banking leaves to the tyres") {
  const CarKnowledge car;
  CHECK(steady_wheel_rad(car, 30.0, 0.0, 0.0) == 0.0);
  const double creeping = steady_wheel_rad(car, 0.1, 1.0 / 100.0, 0.0);
  CHECK(creeping == relative(car.steering_ratio * car.wheelbase_m / 100.0, 1e-3));
  const double flat = steady_wheel_rad(car, 30.0, 1.0 / 500.0, 0.0);
  CHECK(flat == doctest::Approx(car.steering_ratio * (car.wheelbase_m / 500.0 + car.understeer_radps2pm * 1.8)));
  CHECK(steady_wheel_rad(car, 30.0, -1.0 / 500.0, 0.0) == -flat);
  CHECK(steady_wheel_rad(car, 30.0, 1.0 / 500.0, -0.025) < flat);  // The right side lifted.
}

TEST_CASE("every named driver exists and another name is refused") {
  for (const char* name : {"plain", "novice", "experienced", "tired", "escort"}) CHECK(find_driver(name)->name == name);
  const auto driver = find_driver("drunk");
  REQUIRE_FALSE(driver.has_value());
  CHECK(driver.error().remedy == "use one of: plain, novice, experienced, tired, escort");
}

}  // namespace septet::driver
