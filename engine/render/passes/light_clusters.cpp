#include "engine/render/passes/light_clusters.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "engine/light/beam.hpp"

namespace septet::render {
namespace {

struct NearLight {
  glm::vec3 place_m;  ///< Relative to the eye.
  glm::vec3 direction;
  float intensity, main_beam;
};

/// True if the most light that a lamp may send to any place of a square reaches the lower bound: the place is taken no
/// nearer and no further off the beam's axis than the circle around the square allows.
bool may_reach(const NearLight& light, const glm::vec2& middle_m) {
  constexpr float around_m = 0.7072f * LightClusters::square_m;
  const glm::vec2 way = middle_m - glm::vec2(light.place_m), ahead = glm::vec2(light.direction);
  const float distance_m = glm::length(way);
  if (distance_m < 1.5f * around_m) return true;
  const float nearest_m = distance_m - around_m;
  const float level = glm::length(ahead);
  if (level < 0.5f) return true;  // The lamp points up or down: its car has turned over.
  const float angle = std::acos(std::clamp(glm::dot(way, ahead) / (distance_m * level), -1.0f, 1.0f)) -
                      std::asin(std::min(1.0f, around_m / distance_m));
  if (angle > 1.57f) return false;
  // A beam's share falls off its axis as 1/(1 + 59·tan²) (engine/light/beam.hpp); a slope of the road tilts it a
  // little. The main beam falls more steeply.
  const float aside = std::tan(std::max(0.0f, angle - 0.05f));
  return light.intensity * (1.0f + light::main_beam_peak * light.main_beam) /
             ((1.0f + 59.0f * aside * aside) * (nearest_m * nearest_m + 1.0f)) >=
         LightClusters::least_irradiance;
}

}  // namespace

LightClusters light_clusters(const Vec3& eye_m, std::span<const Headlight> headlights) {
  std::vector<NearLight> lights;
  for (const Headlight& light : headlights)
    lights.push_back({glm::vec3(light.position_m - eye_m), light.direction, light.intensity, light.main_beam});
  const auto square = [](const NearLight& light) { return glm::dot(light.place_m, light.place_m); };
  std::ranges::stable_sort(lights, {}, square);
  lights.resize(std::min(lights.size(), LightClusters::most_lights), {});

  constexpr std::uint32_t side = LightClusters::side, squares = side * side;
  LightClusters clusters;
  std::vector<std::uint32_t>& words = clusters.words;
  words.resize(squares + 1);
  for (const NearLight& light : lights)
    for (const float value : {light.place_m.x, light.place_m.y, light.place_m.z, light.intensity, light.direction.x,
                              light.direction.y, light.direction.z, light.main_beam})
      words.push_back(std::bit_cast<std::uint32_t>(value));
  for (std::uint32_t at = 0; at < squares; ++at) {
    words[at] = static_cast<std::uint32_t>(words.size());
    const glm::vec2 middle_m =
        (glm::vec2(at % side, at / side) - 0.5f * static_cast<float>(side - 1)) * LightClusters::square_m;
    for (std::size_t i = 0; i < lights.size(); ++i)
      if (may_reach(lights[i], middle_m))
        words.push_back(squares + 1 + static_cast<std::uint32_t>(i) * LightClusters::words_a_light);
  }
  words[squares] = static_cast<std::uint32_t>(words.size());
  return clusters;
}

FrameData store_light_clusters(PassContext& context, const Vec3& eye_m, std::span<const Headlight> headlights) {
  if (!context.refinements.clustered_headlights || headlights.empty()) return {};
  const LightClusters clusters = light_clusters(eye_m, headlights);
  return store(context, std::span<const std::uint32_t>(clusters.words));
}

}  // namespace septet::render
