#include "engine/physics/vehicle/ground.hpp"

#include <doctest/doctest.h>

using namespace septet::vehicle;

TEST_CASE("ice is most slippery at its melting point") {
  for (double celsius = -25.0; celsius < 0.0; celsius += 1.0)
    CHECK(peak_friction(SurfaceKind::ice, 273.15 + celsius) > peak_friction(SurfaceKind::ice, 273.15));
}

TEST_CASE("surfaces rank dry over wet over snow over ice at every temperature") {
  for (double kelvin = 240.0; kelvin < 310.0; kelvin += 2.5) {
    CHECK(peak_friction(SurfaceKind::dry, kelvin) > peak_friction(SurfaceKind::wet, kelvin));
    CHECK(peak_friction(SurfaceKind::wet, kelvin) > peak_friction(SurfaceKind::snow, kelvin));
    CHECK(peak_friction(SurfaceKind::snow, kelvin) > peak_friction(SurfaceKind::ice, kelvin));
  }
}

TEST_CASE("a wet road freezes over below zero") {
  CHECK(weather_friction(1.0, 0.0, 280.0) == doctest::Approx(peak_friction(SurfaceKind::wet, 280.0)));
  CHECK(weather_friction(1.0, 0.0, 265.0) == doctest::Approx(peak_friction(SurfaceKind::ice, 265.0)));
  CHECK(weather_friction(0.0, 0.0, 265.0) == doctest::Approx(peak_friction(SurfaceKind::dry, 265.0)));
}

TEST_CASE("a wet road is water down to one degree of frost and no wetness is more than wet") {
  CHECK(weather_friction(1.0, 0.0, 272.3) == doctest::Approx(peak_friction(SurfaceKind::wet, 272.3)));
  CHECK(weather_friction(1.0, 0.0, 272.0) == doctest::Approx(peak_friction(SurfaceKind::ice, 272.0)));
  CHECK(weather_friction(0.5, 0.0, 280.0) == doctest::Approx(0.5 * (0.9 + 0.55)));
  CHECK(weather_friction(3.0, 0.0, 280.0) == doctest::Approx(0.55));
  CHECK(weather_friction(-1.0, 0.0, 280.0) == doctest::Approx(0.9));
  CHECK(weather_friction(0.3, 1.0, 265.0) == doctest::Approx(peak_friction(SurfaceKind::snow, 265.0)));
  CHECK(weather_friction(0.0, 2.0, 265.0) == doctest::Approx(peak_friction(SurfaceKind::snow, 265.0)));
}

TEST_CASE("measured ice keeps its coefficient at minus five and gets more slippery as it thaws") {
  CHECK(given_friction(SurfaceKind::ice, 0.12, 0.0, 0.0, 268.15) == doctest::Approx(0.12));
  CHECK(given_friction(SurfaceKind::ice, 0.12, 0.0, 0.0, 273.15) == doctest::Approx(0.12 * 0.06 / 0.10));
  CHECK(given_friction(SurfaceKind::ice, 0.12, 0.0, 0.0, 253.15) == doctest::Approx(0.12 * 0.15 / 0.10));
}

TEST_CASE("a measured dry surface gets wet and frozen in proportion to asphalt") {
  CHECK(given_friction(SurfaceKind::dry, 0.7, 0.0, 0.0, 290.0) == doctest::Approx(0.7));
  CHECK(given_friction(SurfaceKind::dry, 0.7, 1.0, 0.0, 290.0) == doctest::Approx(0.7 * 0.55 / 0.9));
}
