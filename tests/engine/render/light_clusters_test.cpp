#include "engine/render/passes/light_clusters.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/core/random.hpp"
#include "engine/instant/headlight_beam.hpp"
#include "engine/light/beam.hpp"

namespace septet::render {
namespace {

/// Lights of a place relative to the eye, distinguished by their intensities.
std::vector<float> asked_at(const LightClusters& clusters, const glm::vec3& place_m) {
  const float half = 0.5f * LightClusters::side;
  const auto x = static_cast<std::uint32_t>(std::floor(place_m.x / LightClusters::square_m + half)),
             y = static_cast<std::uint32_t>(std::floor(place_m.y / LightClusters::square_m + half));
  const std::uint32_t at = y * LightClusters::side + x;
  std::vector<float> intensities;
  for (std::uint32_t i = clusters.words[at]; i < clusters.words[at + 1]; ++i)
    intensities.push_back(std::bit_cast<float>(clusters.words[clusters.words[i] + 3]));
  return intensities;
}

}  // namespace

TEST_CASE("whatever lights a place as much as can be seen is on its square's list, and most lists are short") {
  Random random(7);
  const auto within = [&](double half) { return half * (2.0 * random.uniform() - 1.0); };
  const Vec3 eye_m(4000.0, -250.0, 31.0);
  std::vector<Headlight> headlights;
  for (int i = 0; i < 40; ++i) {
    const double heading = within(3.14), slope = within(0.06);
    const glm::dvec3 direction(std::cos(heading) * std::cos(slope), std::sin(heading) * std::cos(slope),
                               std::sin(slope));
    headlights.push_back({eye_m + Vec3(within(220.0), within(220.0), within(3.0)), glm::vec3(direction),
                          instant::beam::pair_intensity * (1.0f + 0.001f * static_cast<float>(i)),
                          i % 4 == 0 ? 1.0f : 0.0f});
  }
  const LightClusters clusters = light_clusters(eye_m, headlights);
  std::size_t asked = 0, seen = 0;
  constexpr int places = 4000;
  for (int i = 0; i < places; ++i) {
    const glm::vec3 place_m(within(239.0), within(239.0), within(4.0));
    const std::vector<float> list = asked_at(clusters, place_m);
    asked += list.size();
    for (const Headlight& light : headlights) {
      const glm::vec3 way = place_m - glm::vec3(light.position_m - eye_m);
      const float square = glm::dot(way, way);
      const float arriving = light.intensity *
                             light::beam_share(light.direction, way / std::sqrt(square), light.main_beam, 1.0f) /
                             (square + 1.0f);
      if (arriving < LightClusters::least_irradiance) continue;
      ++seen;
      CHECK(std::count(list.begin(), list.end(), light.intensity) == 1);
    }
  }
  CHECK(seen > 1000);
  CHECK(static_cast<double>(asked) / places < 20.0);
}

TEST_CASE("of a hundred headlights the nearest sixty-four light, and without any all lists are empty") {
  std::vector<Headlight> headlights;
  for (int i = 0; i < 100; ++i)
    headlights.push_back({Vec3(2.0 * i, 0.0, 0.7), {1, 0, 0}, 100.0f - static_cast<float>(i)});
  const LightClusters clusters = light_clusters({}, headlights), none = light_clusters({}, {});
  constexpr std::uint32_t squares = LightClusters::side * LightClusters::side;
  CHECK(clusters.words[0] == squares + 1 + LightClusters::most_lights * LightClusters::words_a_light);
  CHECK(asked_at(clusters, {150.0f, 1.0f, 0.0f}).size() <= LightClusters::most_lights);
  CHECK(none.words.size() == squares + 1);
  CHECK(asked_at(none, {1.0f, 1.0f, 0.0f}).empty());
}

}  // namespace septet::render
