#include "engine/math/spherical_interpolation.hpp"

#include <cmath>

#include <doctest/doctest.h>

using namespace septet;

TEST_CASE("a turn that varies quadratically begins and ends at the rates that it was made of") {
  for (const Vec2& rates : {Vec2(1.0, 3.0), Vec2(3.0, 1.0), Vec2(0.0, 2.0), Vec2(2.0, 0.0), Vec2(1.0, 1.0)}) {
    const double start = rates.x, end = rates.y;
    CAPTURE(start);
    CAPTURE(end);
    const double sigma = sigma_from_rates(start, end), step = 1e-6;
    const double first = varied_share(sigma, step) / step, last = (1.0 - varied_share(sigma, 1.0 - step)) / step;
    CHECK(std::abs(first * end - last * start) < 1e-4);
    CHECK(first + last == doctest::Approx(2.0));
  }
  CHECK(sigma_from_rates(-1.0, 5.0) == 1.0);
  CHECK(sigma_from_rates(1.0, -1.0) == 0.0);
}
