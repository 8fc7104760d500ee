#include "engine/physics/impact/crush_curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "engine/core/random.hpp"
#include "tests/engine/physics/impact/pairs.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::impact;

namespace {

const Stiffness wall{INFINITY, {}};

Stiffness random_stiffness(Random& random) {
  return {std::exp(random.uniform(std::log(5.0), std::log(40000.0))),
          {random.uniform(15.0, 40.0), random.uniform(0.1, 1.0), random.uniform(1.0, 8.0)}};
}

}  // namespace

TEST_CASE("a car at a wall crushes by V/ω in a quarter of its period, and less beyond its crumple zone") {
  const Stiffness car{1500.0, passenger_car_crush()};
  const CrushCurve curve = crush_curve(car, wall);
  const double frequency = passenger_car_crush().frequency_radps;
  for (const double speed : {0.1, 5.0, 15.0}) {
    CHECK(depth_m(curve, speed) == relative(speed / frequency, 1e-12));
    CHECK(compression_s(curve, speed) == relative(0.5 * std::numbers::pi / frequency, 1e-12));
  }
  CHECK(depth_m(curve, 60.0) < 0.65 * 60.0 / frequency);
  CHECK(compression_s(curve, 60.0) < 0.06);
}

TEST_CASE("two equal cars crush alike, a heavy one less than a light one by their masses") {
  const Stiffness car{1500.0, passenger_car_crush()}, van{3000.0, passenger_car_crush()};
  const CrushShares equal = crush_shares(car, car, 0.5);
  CHECK(equal.first_m == relative(0.25, 1e-12));
  CHECK(equal.second_m == relative(0.25, 1e-12));
  const CrushShares unequal = crush_shares(car, van, 0.6);
  CHECK(unequal.first_m == relative(0.4, 1e-12));
  CHECK(unequal.second_m == relative(0.2, 1e-12));
}

TEST_CASE("depth and speed are each other's inverse, shares add up, and the course ends at the depth") {
  Random random(seed);
  for (int i = 0; i < 5000; ++i) {
    const Stiffness first = random_stiffness(random), second = random.uniform() < 0.3 ? wall : random_stiffness(random);
    const CrushCurve curve = crush_curve(first, second);
    const double speed = random.uniform(0.01, 60.0), depth = depth_m(curve, speed);
    CHECK(speed_mps(curve, depth) == relative(speed, 1e-9));
    const CrushShares shares = crush_shares(first, second, depth);
    CHECK(shares.first_m + shares.second_m == relative(depth, 1e-9));
    const double end_s = compression_s(curve, speed);
    const Approach end = approach_at(curve, speed, end_s);
    CHECK(end.depth_m == relative(depth, 1e-9));
    CHECK(std::abs(end.speed_mps) < 1e-6 * speed);
  }
}

TEST_CASE("the course obeys its deceleration") {
  Random random(seed, 1);
  for (int i = 0; i < 20; ++i) {
    const CrushCurve curve = crush_curve(random_stiffness(random), random_stiffness(random));
    const double speed = random.uniform(1.0, 60.0), end_s = compression_s(curve, speed);
    // Integrated by leapfrog with 20,000 steps.
    double depth = 0.0, v = speed;
    const int steps = 20000;
    const double dt = end_s / steps;
    double worst = 0.0;
    for (int k = 0; k < steps; ++k) {
      v -= 0.5 * dt * deceleration_mps2(curve, depth);
      depth += dt * v;
      v -= 0.5 * dt * deceleration_mps2(curve, depth);
      if (k % 1000 == 0) worst = std::max(worst, std::abs(depth - approach_at(curve, speed, (k + 1) * dt).depth_m));
    }
    CHECK(worst < 1e-6);
    CHECK(std::abs(v) < 1e-5 * speed);
  }
}
