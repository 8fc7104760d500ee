#include "engine/instant/clouds.hpp"

#include <array>
#include <cmath>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/relative.hpp"

namespace septet::instant {
namespace {

/// A light and even sky around a high sun.
SkyLight sky() {
  SkyLight light;
  light.sun_direction = glm::normalize(glm::vec3(0.3f, 0.2f, 0.9f));
  light.light_irradiance = glm::vec3(8.0f);
  light.sky_irradiance = glm::vec3(1.0f);
  return light;
}

/// Mean cover over the sky above 45°.
double mean_cover(std::span<const std::uint8_t> noise, double cloud_cover, const glm::vec2& drift_m = glm::vec2(0.0f)) {
  double sum = 0.0;
  int count = 0;
  for (float x = -0.7f; x <= 0.7f; x += 0.02f)
    for (float y = -0.7f; y <= 0.7f; y += 0.02f) {
      if (x * x + y * y > 0.49f) continue;
      sum += double(cloud_seen(noise, sky(), cloud_cover, drift_m, {x, y, std::sqrt(1.0f - x * x - y * y)}).cover);
      ++count;
    }
  return sum / count;
}

}  // namespace

TEST_CASE("the noise of clouds holds every rank as often as any other") {
  const auto noise = cloud_noise();
  REQUIRE(noise.size() == std::size_t{cloud_noise_side} * cloud_noise_side);
  std::array<double, 8> share{};
  for (const std::uint8_t rank : noise) share[rank / 32] += 1.0 / static_cast<double>(noise.size());
  for (const double each : share) CHECK(each == relative(0.125, 0.03));
}

TEST_CASE("a clear sky has no clouds and the more the weather has the more are seen") {
  const auto noise = cloud_noise();
  CHECK(mean_cover(noise, 0.0) == 0.0);
  double before = 0.0;
  for (const double cover : {0.25, 0.5, 0.75, 1.0}) {
    const double seen = mean_cover(noise, cover);
    CHECK(seen > before);
    CHECK(seen < cover);  // Their edges are thin.
    before = seen;
  }
  CHECK(before > 0.45);
  // No clouds below the horizon's haze.
  CHECK(cloud_seen(noise, sky(), 1.0, glm::vec2(0.0f), {1.0f, 0.0f, 0.0f}).cover == 0.0f);
}

TEST_CASE("clouds drift with the wind and come back after nine kilometres") {
  const auto noise = cloud_noise();
  Environment windy;
  windy.wind_speed_mps = 10.0;
  windy.wind_direction_rad = 0.0;  // Towards x.
  const glm::vec2 drift = cloud_drift_m(windy, 60.0);
  CHECK(drift.x == doctest::Approx(-1200.0));
  CHECK(drift.y == doctest::Approx(0.0).scale(1));
  // Clouds overhead have moved further along x.
  const float z = 0.8f, per_m = (z + 0.12f) / 1600.0f;
  const glm::vec3 overhead{-0.3f, 0.0f, z}, later{-0.3f + 300.0f * per_m, 0.0f, z};
  CHECK(cloud_seen(noise, sky(), 0.9, {-300.0f, 0.0f}, later).cover ==
        relative(double(cloud_seen(noise, sky(), 0.9, {0.0f, 0.0f}, overhead).cover), 0.001));
  CHECK(mean_cover(noise, 0.6, {9000.0f, -9000.0f}) == relative(mean_cover(noise, 0.6), 0.001));
}

}  // namespace septet::instant
