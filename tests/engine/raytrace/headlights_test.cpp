#include "engine/raytrace/headlights.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/light/beam.hpp"
#include "tests/relative.hpp"

namespace septet::raytrace {
namespace {

/// Row of cars on a road along x, every fifth with its main beam lit, every third facing away from the lit place.
std::vector<instant::Headlight> cars(std::size_t count) {
  std::vector<instant::Headlight> headlights;
  for (std::size_t n = 0; n < count; ++n) {
    const double back_m = 9.0 + 7.0 * static_cast<double>(n);
    headlights.push_back({{1000.0 - back_m, 500.0 + static_cast<double>(n % 3), 20.7},
                          {n % 3 == 2 ? -1.0f : 1.0f, 0.0f, 0.0f},
                          2.0f + static_cast<float>(n % 4),
                          n % 5 == 3 ? 1.0f : 0.0f});
  }
  return headlights;
}

constexpr float half_open = 0.5f;
const Vec3 origin_m{1000.0, 500.0, 20.0};
const glm::vec3 place_m(0.5f, 0.3f, 0.1f), way_m(1.0f, 0.2f, 0.0f);

float strength(const instant::Headlight& light) {
  const glm::vec3 way = place_m - glm::vec3(light.position_m - origin_m) - half_open * way_m;
  const float square = glm::dot(way, way);
  return light.intensity * light::beam_share(light.direction, way / std::sqrt(square), light.main_beam, 1.0f) /
         (square + 1.0f);
}

TEST_CASE("each of many headlights is drawn as often as it is a share of their light, and one that shines away never") {
  for (const std::size_t count : {1, 7, 8, 27}) {
    CAPTURE(count);
    const auto headlights = cars(count);
    const HeadlightRow row(headlights, std::vector<glm::vec3>(count, way_m), origin_m);
    float expected = 0.0f;
    for (const instant::Headlight& light : headlights) expected += strength(light);
    const float sum = row.sum(place_m, half_open);
    CHECK(sum == relative(expected, 1e-5));
    constexpr int draws = 20'000;
    std::vector<int> drawn(count);
    for (int n = 0; n < draws; ++n) {
      const DrawnHeadlight one = row.drawn(place_m, half_open, (static_cast<float>(n) + 0.5f) / draws, sum);
      ++drawn.at(one.which);
      REQUIRE(one.strength == relative(strength(headlights[one.which]), 1e-5));
      REQUIRE(one.strength > 0.0f);
    }
    for (std::size_t n = 0; n < count; ++n)
      CHECK(std::abs(static_cast<float>(drawn[n]) - draws * strength(headlights[n]) / expected) < 2.0f);
    CHECK(row.drawn(place_m, half_open, 1.0f, sum).strength > 0.0f);  // Rounding leads past the end here.
  }
}

TEST_CASE("no headlights give no light") {
  const HeadlightRow none({}, {}, origin_m);
  CHECK(none.sum(place_m, 0.0f) == 0.0f);
}

}  // namespace
}  // namespace septet::raytrace
