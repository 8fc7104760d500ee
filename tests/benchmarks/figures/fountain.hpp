#pragma once
/// A fountain in the Cornell box, after figure 6 of Johansson et al., "Distributed Ray Tracing in an Open Source
/// Environment": one closed body of clear water, a jet that falls back over its own top into a pool, with ripples and
/// drops. A surface of revolution about z with waves; the paper's was a level set of a fluid simulation.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "engine/raytrace/world.hpp"

namespace septet::raytrace {

/// Adds a closed surface of revolution: points of the outline (radius, height) from one end of the axis to the other,
/// upwards.
inline void add_turned(std::vector<scene::SurfaceVertex>& soup, const std::vector<glm::vec2>& outline, int spokes,
                       const glm::vec3& foot_m, float ripple_m) {
  const auto at = [&](std::size_t ring, int spoke) {
    const float azimuth = 6.2831853f * static_cast<float>(spoke % spokes) / static_cast<float>(spokes);
    const glm::vec2& p = outline[ring];
    // Waves are lower towards the axis, where all spokes meet.
    const float wave = ripple_m * std::min(1.0f, 6.0f * p.x) *
                       (std::sin(9.0f * azimuth + 31.0f * p.y) + 0.6f * std::sin(5.0f * azimuth - 47.0f * p.x));
    const float radius = p.x > 0.0f ? std::max(1e-4f, p.x + wave) : 0.0f;
    return foot_m + glm::vec3(radius * std::cos(azimuth), radius * std::sin(azimuth), p.y + 0.5f * wave);
  };
  const auto rings = outline.size();
  // A vertex's normal by its neighbours along the ring and across rings.
  const auto vertex = [&](std::size_t ring, int spoke) {
    const std::size_t below = ring > 0 ? ring - 1 : ring, above = std::min(ring + 1, rings - 1);
    const glm::vec3 along = at(ring, spoke + 1) - at(ring, spoke + spokes - 1),
                    up = at(above, spoke) - at(below, spoke);
    glm::vec3 normal = glm::cross(along, up);
    if (!(glm::length(normal) > 1e-12f)) normal = glm::vec3(0.0f, 0.0f, ring == 0 ? -1.0f : 1.0f);
    return scene::SurfaceVertex{at(ring, spoke), glm::normalize(normal), {}};
  };
  for (std::size_t ring = 0; ring + 1 < rings; ++ring)
    for (int spoke = 0; spoke < spokes; ++spoke) {
      const std::array<scene::SurfaceVertex, 4> c{vertex(ring, spoke), vertex(ring, spoke + 1),
                                                  vertex(ring + 1, spoke + 1), vertex(ring + 1, spoke)};
      if (outline[ring].x > 0.0f) soup.insert(soup.end(), {c[0], c[1], c[2]});
      if (outline[ring + 1].x > 0.0f) soup.insert(soup.end(), {c[0], c[2], c[3]});
    }
}

/// On the box's floor, z = −1. `spokes`: how fine it is.
inline std::vector<ClearBody> fountain(int spokes) {
  ClearBody water{.index = 1.333f, .absorption_per_m = glm::vec3(0.35f, 0.08f, 0.05f)};
  const int steps = spokes / 2;
  std::vector<glm::vec2> outline;
  // The pool's bottom and rim, its surface with rings of waves inwards, the jet, its crown that falls back, and the
  // top.
  outline.emplace_back(0.0f, 0.01f);
  outline.emplace_back(0.78f, 0.01f);
  const auto line = [&](int count, const auto& point) {
    for (int n = 0; n < count; ++n) outline.push_back(point(static_cast<float>(n) / static_cast<float>(count)));
  };
  line(steps / 4, [](float t) { return glm::vec2(0.80f - 0.03f * t * t, 0.02f + 0.14f * t); });
  line(steps, [](float t) {
    const float radius = 0.77f - 0.66f * t;
    return glm::vec2(radius, 0.16f + 0.018f * std::sin(60.0f * radius) * t);
  });
  line(steps, [](float t) { return glm::vec2(0.11f - 0.055f * t + 0.006f * std::sin(40.0f * t), 0.16f + 0.74f * t); });
  line(steps, [](float t) { return glm::vec2(0.055f + 0.30f * t, 0.90f + 0.16f * t - 0.42f * t * t); });
  line(steps, [](float t) { return glm::vec2(0.355f - 0.30f * t, 0.64f + 0.62f * t - 0.21f * t * t); });
  outline.emplace_back(0.05f, 1.06f);
  outline.emplace_back(0.0f, 1.08f);
  add_turned(water.vertices, outline, spokes, glm::vec3(0.0f, 0.0f, -1.0f), 0.008f);
  // Drops, where they fall from the crown.
  for (int n = 0; n < 26; ++n) {
    const float azimuth = 2.39996f * static_cast<float>(n), away = 0.36f + 0.012f * static_cast<float>(n % 9);
    const float radius = 0.018f + 0.004f * static_cast<float>(n % 5),
                height = 0.24f + 0.05f * static_cast<float>(n * 7 % 9);
    std::vector<glm::vec2> drop{{0.0f, -radius}};
    for (int k = 1; k < 10; ++k)
      drop.emplace_back(radius * std::sin(0.314159f * static_cast<float>(k)),
                        -radius * std::cos(0.314159f * static_cast<float>(k)));
    drop.emplace_back(0.0f, radius);
    add_turned(water.vertices, drop, 16, {away * std::cos(azimuth), away * std::sin(azimuth), height - 1.0f}, 0.0f);
  }
  return {std::move(water)};
}

}  // namespace septet::raytrace
