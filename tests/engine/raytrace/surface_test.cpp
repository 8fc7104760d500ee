#include "engine/raytrace/surface.hpp"

#include <initializer_list>

#include <doctest/doctest.h>

#include "engine/light/fresnel.hpp"
#include "engine/light/microfacets.hpp"
#include "tests/relative.hpp"

namespace septet::raytrace {
namespace {

/// Integral over the upper hemisphere, by the midpoints of equal solid angles.
template <class Function>
double over_hemisphere(const Function& of, int rings = 2000, int spokes = 200) {
  double sum = 0.0;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < spokes; ++j)
      sum +=
          static_cast<double>(of(from_angles((static_cast<float>(i) + 0.5f) / static_cast<float>(rings),
                                             2.0f * pi * (static_cast<float>(j) + 0.5f) / static_cast<float>(spokes))));
  return sum * 2.0 * std::numbers::pi / (rings * spokes);
}

glm::vec3 viewer(float degrees) { return from_angles(std::cos(degrees * pi / 180.0f), 0.4f); }

}  // namespace

TEST_CASE("microfacets cover their surface exactly and seen from anywhere fill its projection") {
  for (const float alpha : {0.15f, 0.3f, 0.7f}) {
    CAPTURE(alpha);
    CHECK(over_hemisphere([&](const glm::vec3& h) { return light::ggx_density(h.z, alpha) * h.z; }) ==
          relative(1.0, 2e-3));
    for (const float degrees : {5.0f, 40.0f, 75.0f}) {
      const glm::vec3 v = viewer(degrees);
      const double seen = over_hemisphere([&](const glm::vec3& h) {
        return std::max(0.0f, glm::dot(v, h)) * light::ggx_density(h.z, alpha) / (1.0f + smith_lambda(v, alpha));
      });
      CHECK(seen == relative(v.z, 3e-3));
    }
  }
}

TEST_CASE("directions are drawn with the density that they say and weighed with what they carry") {
  Surface surface;
  surface.diffuse = glm::vec3(0.5f);
  surface.f0 = glm::vec3(0.2f);
  for (const float alpha : {0.1f, 0.5f})
    for (const float coat : {0.0f, 1.0f})
      for (const float degrees : {10.0f, 60.0f}) {
        surface.alpha = alpha, surface.coat = coat, surface.coat_alpha = 0.15f;
        const glm::vec3 v = viewer(degrees);
        const double reflected = over_hemisphere([&](const glm::vec3& l) { return scattering(surface, v, l).value.x; });
        const double drawn = over_hemisphere([&](const glm::vec3& l) { return scattering(surface, v, l).pdf; });
        constexpr int samples = 100'000;
        int other_density = 0;
        double weights = 0.0, accepted = 0.0, squares = 0.0;
        for (int n = 0; n < samples; ++n) {
          PathRandom random(7, 0, 0, static_cast<std::uint32_t>(n));
          const Scattered scattered = scatter(surface, v, random);
          weights += scattered.weight.x, squares += scattered.weight.x * scattered.weight.x;
          if (scattered.pdf > 0.0f) {
            ++accepted;
            other_density += std::abs(scattering(surface, v, scattered.direction).pdf / scattered.pdf - 1.0f) > 0.02f;
          }
        }
        CAPTURE(alpha);
        CAPTURE(coat);
        CAPTURE(degrees);
        const double mean = weights / samples, sigma = std::sqrt((squares / samples - mean * mean) / samples);
        CHECK(other_density == 0);
        CHECK(std::abs(mean - reflected) < 4.0 * sigma + 1e-3);
        CHECK(std::abs(accepted / samples - drawn) < 6e-3);
        CHECK(reflected < 1.0);
      }
}

TEST_CASE("an interface reflects as Fresnel says head-on and at Brewster's angle and beyond the critical one") {
  CHECK(light::fresnel(1.0f, 1.0f / 1.5f) == relative(0.04, 1e-5));
  CHECK(light::fresnel(1.0f, 1.0f / 1.31f) == relative(0.01801, 1e-3));
  // Brewster's angle: only light polarised across the plane is reflected, half of ((n² − 1)/(n² + 1))².
  const float brewster = std::cos(std::atan(1.5f));
  CHECK(light::fresnel(brewster, 1.0f / 1.5f) == relative(0.5 * std::pow(1.25 / 3.25, 2), 1e-4));
  CHECK(light::fresnel(0.5f, 1.31f) == 1.0f);  // 60° from within ice; the critical angle is 49.8°.
}

TEST_CASE("numbers of a path depend on seed and pixel and sample and are spread evenly") {
  PathRandom a(1, 2, 3, 4), b(1, 2, 3, 4), other(1, 3, 2, 4);
  double sum = 0.0, product = 0.0;
  for (int n = 0; n < 100'000; ++n) {
    const float x = a.uniform(), y = b.uniform(), z = other.uniform();
    REQUIRE(x == y);
    REQUIRE(x >= 0.0f);
    REQUIRE(x < 1.0f);
    sum += x, product += (x - 0.5) * (z - 0.5);
  }
  CHECK(std::abs(sum / 100'000 - 0.5) < 0.004);
  CHECK(std::abs(product / 100'000) < 0.0012);
  double neighbours = 0.0;
  for (std::uint32_t n = 0; n < 100'000; ++n)
    neighbours += (PathRandom(5, n, 9, 0).uniform() - 0.5) * (PathRandom(5, n + 1, 9, 0).uniform() - 0.5);
  CHECK(std::abs(neighbours / 100'000) < 0.0012);
}

}  // namespace septet::raytrace
