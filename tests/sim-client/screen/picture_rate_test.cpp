#include "sim-client/screen/picture_rate.hpp"

#include <doctest/doctest.h>

#include "tests/relative.hpp"

namespace septet::screen {
namespace {

PictureRate steady(double per_second, double for_s) {
  PictureRate rate;
  for (int i = 0; i <= static_cast<int>(for_s * per_second + 0.5); ++i) rate.add(100.0 + i / per_second);
  return rate;
}

}  // namespace

TEST_CASE("the rate is that of the last seconds and not of the start") {
  PictureRate rate = steady(60.0, 5.0);
  CHECK(rate.per_second().value() == relative(60.0, 0.02));
  for (int i = 1; i <= 40; ++i) rate.add(105.0 + 0.1 * i);
  CHECK(rate.per_second().value() == relative(10.0, 0.06));
}

TEST_CASE("nothing is said of a rate that is not known yet") {
  CHECK_FALSE(steady(60.0, 1.0).per_second());
  CHECK_FALSE(slowness(steady(0.5, 2.0), true));  // Two pictures.
  CHECK_FALSE(slowness(PictureRate{}, true));
}

TEST_CASE("a screen that is too slow says how slow and why and what to do") {
  CHECK(slowness(steady(18.0, 4.0), true).value() ==
        "18 pictures a second: no GPU found, drawing in software; try --virtual, or fewer pixels in the rig");
  CHECK(slowness(steady(1.7, 6.0), true).value().starts_with("1.7 pictures a second: no GPU found"));
  CHECK(slowness(steady(18.0, 4.0), false).value().find("the GPU is too slow") != std::string::npos);
  CHECK_FALSE(slowness(steady(60.0, 4.0), true));
}

}  // namespace septet::screen
