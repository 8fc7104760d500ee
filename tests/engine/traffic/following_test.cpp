#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "engine/traffic/driver.hpp"

namespace septet::traffic {
namespace {

const FollowingLaw car{FollowingParameters{32.0, 1.3, 1.5, 2.5, 2.0}};

double braking(double speed, double leader_speed, double leader_mps2, double gap) {
  return car.with_coolness(car.acceleration(speed, leader_speed, gap), speed, leader_speed, leader_mps2, gap);
}

}  // namespace

TEST_CASE("whoever is cut in upon by an equally fast car does not brake as for a collision") {
  CHECK(car.acceleration(28.0, 28.0, 10.0) == -9.0);
  CHECK(braking(28.0, 28.0, 0.0, 10.0) > -3.0);
  CHECK(braking(28.0, 28.0, 0.0, 10.0) < -2.0);
  CHECK(braking(28.0, 30.0, 1.0, 6.0) > -3.0);
}

TEST_CASE("coolness brakes at least as hard as a collision asks, and no harder than the model") {
  for (double speed = 0.0; speed <= 40.0; speed += 1.0)
    for (double leader = 0.0; leader <= 40.0; leader += 2.5)
      for (const double gap : {0.5, 2.0, 8.0, 30.0, 120.0})
        for (const double leader_mps2 : {-8.0, -2.0, 0.0, 2.0}) {
          const double model = car.acceleration(speed, leader, gap);
          const double cool = braking(speed, leader, leader_mps2, gap);
          REQUIRE(std::isfinite(cool));
          REQUIRE(cool >= model - 1e-12);
          const double closing = speed - leader;
          if (closing <= 0.0) continue;
          const double asked = -closing * closing / (2.0 * gap);
          REQUIRE(cool <= std::max({model, -hardest_braking_mps2, 0.98 * asked}));
        }
}

TEST_CASE("a driver follows one who brakes to a stand and does not touch") {
  for (const double leader_mps2 : {-2.0, -5.0, -8.0}) {
    CAPTURE(leader_mps2);
    const double v0 = 28.0, dt = 0.05;
    double gap = 2.0 + 1.3 * v0, speed = v0, leader = v0, hardest = 0.0;
    for (double t = 0.0; t < 60.0; t += dt) {
      const double a = braking(speed, leader, leader > 0.0 ? leader_mps2 : 0.0, gap);
      hardest = std::min(hardest, a);
      const double before = speed;
      speed = std::max(0.0, speed + a * dt);
      gap += (leader - 0.5 * (before + speed)) * dt;
      leader = std::max(0.0, leader + leader_mps2 * dt);
      REQUIRE(gap > 0.5);
    }
    CHECK(hardest > leader_mps2 - 2.5);
    CHECK(speed < 0.1);
  }
}

}  // namespace septet::traffic
