#include "engine/physics/vehicle/ground.hpp"

#include <doctest/doctest.h>

using namespace septet::vehicle;

TEST_CASE("ice is most slippery at its melting point") {
  for (double celsius = -25.0; celsius < 0.0; celsius += 1.0)
    CHECK(peak_friction(SurfaceKind::ice, 273.15 + celsius) >
          peak_friction(SurfaceKind::ice, 273.15));
}

TEST_CASE("surfaces rank dry over wet over snow over ice at every temperature") {
  for (double kelvin = 240.0; kelvin < 310.0; kelvin += 2.5) {
    CHECK(peak_friction(SurfaceKind::dry, kelvin) > peak_friction(SurfaceKind::wet, kelvin));
    CHECK(peak_friction(SurfaceKind::wet, kelvin) > peak_friction(SurfaceKind::snow, kelvin));
    CHECK(peak_friction(SurfaceKind::snow, kelvin) > peak_friction(SurfaceKind::ice, kelvin));
  }
}

TEST_CASE("a wet road freezes over below zero") {
  CHECK(weather_friction(1.0, 0.0, 280.0) ==
        doctest::Approx(peak_friction(SurfaceKind::wet, 280.0)));
  CHECK(weather_friction(1.0, 0.0, 265.0) ==
        doctest::Approx(peak_friction(SurfaceKind::ice, 265.0)));
  CHECK(weather_friction(0.0, 0.0, 265.0) ==
        doctest::Approx(peak_friction(SurfaceKind::dry, 265.0)));
}
