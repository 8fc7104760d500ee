#include <cmath>

#include <doctest/doctest.h>

#include "car-io/simulated_driver/lane_choice.hpp"
#include "car-io/simulated_driver/mirrors.hpp"
#include "car-io/simulated_driver/pedals.hpp"
#include "car-io/simulated_driver/perception.hpp"
#include "car-io/simulated_driver/steering.hpp"

namespace septet::car_io {

TEST_CASE("the steering gains give the wanted frequency and damping at every speed") {
  const SteeringParameters steering;
  const CarKnowledge car;
  for (const double v : {8.0, 15.0, 28.0, 40.0}) {
    const auto gains = steering_gains(steering, car, v);
    const double yaw_gain =
        v / (car.wheelbase_m + car.understeer_radps2pm * v * v) / car.steering_ratio;
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
    return advance_steering(state, steering, car, {near_rad, 0.0}, sees_road, 25.0, now_s, 0.01,
                            random);
  };
  const double near_gain = steering_gains(steering, car, 25.0).near;
  steer(0.0, true, 0.01);
  CHECK(steer(0.02, false, 0.02) == doctest::Approx(steering.peripheral_share * 0.02 * near_gain));
  CHECK(steer(0.02, true, 0.03) == doctest::Approx(0.02 * near_gain));
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
  CHECK(std::sqrt(squares / count) == doctest::Approx(0.3).epsilon(0.03));
  CHECK(products / squares == doctest::Approx(std::exp(-0.1 / 2.0)).epsilon(0.01));
}

TEST_CASE("the wish is none at the desired speed and at the equilibrium gap") {
  const SpeedParameters speed;
  CHECK(wished_acceleration_mps2(speed, 30.0, 30.0, std::nullopt) == doctest::Approx(0.0));
  CHECK(wished_acceleration_mps2(speed, 0.0, 30.0, std::nullopt) ==
        doctest::Approx(speed.acceleration_mps2));
  const double gap_m = (speed.standstill_gap_m + 20.0 * speed.time_gap_s) /
                       std::sqrt(1.0 - std::pow(20.0 / 30.0, 4));
  CHECK(std::abs(wished_acceleration_mps2(speed, 20.0, 30.0, Obstacle{gap_m, 20.0})) < 1e-9);
  CHECK(wished_acceleration_mps2(speed, 20.0, 30.0, Obstacle{5.0, 0.0}) < -5.0);
}

TEST_CASE("accelerator and brake are never pressed together") {
  PedalState pedals;
  Random random(2);
  OwnPlace own;
  own.speed_mps = 25.0;
  bool braked = false, accelerated = false;
  for (int i = 0; i < 120 * 40; ++i) {
    const double now_s = i / 120.0;
    const bool blocked = std::fmod(now_s, 8.0) < 4.0;
    advance_pedals(pedals, {}, {}, own, 30.0,
                   blocked ? std::optional(Obstacle{20.0, 18.0}) : std::nullopt, now_s, 1.0 / 120.0,
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

TEST_CASE("a change is safe with room and refused beside and before a faster one") {
  OwnPlace own;
  own.lane = 3;
  own.speed_mps = 25.0;
  std::vector<SeenVehicle> vehicles(1);
  vehicles[0].lane = 2;
  const LaneScene scene{.own = own, .vehicles = vehicles, .desired_speed_mps = 30.0};
  const auto is_safe_with = [&](bool ahead, double gap_m, double speed_mps) {
    vehicles[0].is_ahead = ahead;
    vehicles[0].gap_m = gap_m;
    vehicles[0].speed_mps = speed_mps;
    return is_safe(scene, 2, DriverParameters{});
  };
  CHECK(is_safe_with(false, 40.0, 25.0));
  CHECK_FALSE(is_safe_with(false, -3.0, 25.0));
  CHECK_FALSE(is_safe_with(false, 30.0, 40.0));
  CHECK(is_safe_with(false, 60.0, 28.0));
  CHECK_FALSE(is_safe_with(true, 12.0, 10.0));
  vehicles[0].lane = 4;
  vehicles[0].also_in_lane = 2;
  CHECK_FALSE(is_safe_with(true, 2.0, 25.0));
}

TEST_CASE("every named driver exists and another name is refused") {
  for (const char* name : {"plain", "novice", "experienced", "tired"})
    CHECK(find_driver(name)->name == name);
  const auto driver = find_driver("drunk");
  REQUIRE_FALSE(driver.has_value());
  CHECK(driver.error().remedy == "use one of: plain, novice, experienced, tired");
}

}  // namespace septet::car_io
