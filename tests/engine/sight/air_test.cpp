#include "engine/sight/air.hpp"

#include <array>
#include <limits>

#include <doctest/doctest.h>

#include "engine/sight/line_of_sight.hpp"
#include "tests/relative.hpp"

namespace septet::sight {

TEST_CASE("rain hides as much as its drops do, snow more, and neither where none falls") {
  double mm_per_h = 0.0, kelvin = 283.0;
  CHECK(fall_extinction_per_m(mm_per_h, kelvin) == 0.0);
  // Per km, for millimetres an hour.
  for (const std::array<double, 2>& row : {std::array{1.0, 0.31}, std::array{5.0, 0.92}, std::array{10.0, 1.46},
                                           std::array{25.0, 2.7}, std::array{50.0, 4.3}}) {
    mm_per_h = row[0];
    CHECK(1000.0 * fall_extinction_per_m(mm_per_h, kelvin) == relative(row[1], 0.02));
  }
  mm_per_h = 2.0;
  const double rain = fall_extinction_per_m(mm_per_h, kelvin);
  kelvin = 273.0;
  const double wet_snow = fall_extinction_per_m(mm_per_h, kelvin);
  kelvin = 265.0;
  const double dry_snow = fall_extinction_per_m(mm_per_h, kelvin);
  CHECK(wet_snow > 2.0 * rain);
  CHECK(dry_snow > wet_snow);
  for (const double nonsense : {-3.0, std::numeric_limits<double>::quiet_NaN(), 1e300}) {
    mm_per_h = nonsense;
    CHECK(fall_extinction_per_m(mm_per_h, kelvin) >= 0.0);
    CHECK(fall_extinction_per_m(mm_per_h, kelvin) < 4.0);
  }
}

TEST_CASE("what reflects is seen to a depth of three by day and by dipped beams in clear air to sixty metres") {
  const Line ahead;
  const auto seen = [&](double per_m, double natural_lx) {
    return seen_m(
        ahead, 400.0, 1.0, [&](const Vec3&) { return per_m; },
        [&](double depth, double m) { return sees_reflecting(depth, natural_lx + dipped_light_lx(m, depth)); });
  };
  CHECK(seen(0.05, 10000.0) == relative(60.0, 1e-3));
  CHECK(seen(0.0, 10000.0) == 400.0);
  CHECK(seen(0.0, 0.0) == relative(60.0, 0.03));
  // In fog the beams' light is dimmed on its way there too.
  CHECK(seen(0.05, 0.0) < 0.75 * seen(0.0, 0.0));
}

TEST_CASE("the distance that is seen ends within a step and agrees with the transmittance to there") {
  const auto smoke = [](const Vec3& at) { return at.x > 20.3 ? 0.4 : 0.01; };
  const Line ahead;
  const double m = seen_m(ahead, 100.0, 0.5, smoke, [](double depth, double) { return depth <= visible_depth(true); });
  CHECK(m == relative(20.3 + (8.0 - 0.203) / 0.4, 0.01));
  CHECK(transmittance(ahead, m, 0.5, smoke) == relative(std::exp(-8.0), 0.1));
}

TEST_CASE("one who drives at the stopping speed stops within the distance") {
  for (const double m : {0.0, 5.0, 40.0, 150.0}) {
    const double mps = stopping_speed_mps(m, 1.0, 4.0);
    CHECK(mps * 1.0 + mps * mps / 8.0 == doctest::Approx(m));
  }
  CHECK(stopping_speed_mps(-3.0, 1.0, 4.0) == 0.0);
}

TEST_CASE("a lorry's spray in standing water takes seventy percent of the light and none below 8 m/s") {
  CHECK(1.0 - std::exp(-spray_wake(true, 25.0, 1.0).depth) == relative(0.7, 0.01));
  CHECK(1.0 - std::exp(-spray_wake(false, 25.0, 1.0).depth) == relative(0.25, 0.01));
  CHECK(spray_wake(true, 7.9, 1.0).depth == 0.0);
  CHECK(spray_wake(true, 25.0, 0.1).depth == 0.0);
}

}  // namespace septet::sight
