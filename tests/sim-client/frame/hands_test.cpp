#include <algorithm>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "sim-client/frame/cockpit_drawing.hpp"

namespace septet::frame {

TEST_CASE("hands hold the wheel as far as they reach, then go over each other and never further") {
  for (const double rad : {0.0, 0.1, -0.5, 0.99, -0.99}) CHECK(hands_rad(rad) == doctest::Approx(rad));
  double furthest = 0.0, turned_with = 0.0, before = hands_rad(-9.0);
  for (double rad = -9.0; rad < 9.0; rad += 0.001) {
    const double now = hands_rad(rad);
    furthest = std::max(furthest, std::abs(now));
    CHECK(std::abs(now - before) < 0.001 * 1.01 * std::max(1.0, hands_reach_rad / hands_back_in_rad));
    CHECK(now * rad >= 0.0);  // Hands on the side to which the wheel has been turned.
    turned_with += std::abs(now - before - 0.001) < 1e-9;
    before = now;
  }
  CHECK(furthest <= hands_reach_rad + 1e-9);
  CHECK(furthest < 70.0 / 57.29578);
  CHECK(turned_with > 0.6 * 18000);  // Most of the time they hold it.
  CHECK(hands_rad(std::nan("")) == 0.0);
  CHECK(hands_rad(std::numeric_limits<double>::infinity()) == 0.0);
}

}  // namespace septet::frame
