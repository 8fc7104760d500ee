#pragma once
/// Random draws of a point on a lamp, of a headlight, and of a direction of scattering in smoke, for a point of a path.
/// Inline, for a path does little else (4 % of trace/cornell).

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <glm/geometric.hpp>

#include "engine/light/beam.hpp"
#include "engine/raytrace/world.hpp"

namespace septet::raytrace {

inline constexpr float evenly_per_sr = 0.25f / pi;

/// Scatters isotropically, as smoke does.
inline Scattered scatter_evenly(const glm::vec3& albedo, PathRandom& random) {
  const glm::vec2 u = random.pair();
  const float up = 1.0f - 2.0f * u.x, across = std::sqrt(std::max(0.0f, 1.0f - up * up));
  return {glm::vec3(across * on_circle(u.y), up), albedo, evenly_per_sr};
}

/// Draws a point on a lamp. `weights`: the lamps' at `from_m`. `distance_m`: to that point, set where there is light.
[[gnu::always_inline]] inline LightSample draw_lamp(const World& world, const LampWeights& weights,
                                                    const glm::vec3& from_m, float time, PathRandom& random,
                                                    float& distance_m) {
  if (!(weights.sum() > 0.0f)) return {};
  const std::size_t chosen = world.lamps().size() > 1 ? weights.drawn(random.uniform()) : 0;
  const Lamp& lamp = world.lamps()[chosen];
  const std::size_t which = lamp.triangles.size() > 1 ? lamp.drawn_triangle(random.uniform()) : 0;
  const LampTriangle& triangle = lamp.triangles[which];
  const glm::vec2 drawn = random.pair();
  const float root = std::sqrt(drawn.x);
  const float u = root * (1.0f - drawn.y), v = root * drawn.y;
  const glm::vec3 way = triangle.corner_m + u * triangle.second + v * triangle.third + lamp.way_m * time - from_m;
  const float square = glm::dot(way, way), per_m = 1.0f / std::sqrt(square);
  distance_m = square * per_m;
  const glm::vec3 direction = way * per_m;
  const float cosine = -glm::dot(triangle.normal, direction);
  if (!(cosine > 1e-6f)) return {};
  glm::vec3 emission = lamp.emission * lamp.share_at(cosine);
  if (lamp.textured) {
    Ray ray;
    ray.origin_m = from_m;
    ray.direction = direction;
    ray.time = time;
    SurfacePoint there;
    world.point(ray, {distance_m, lamp.place, lamp.first_triangle + static_cast<std::uint32_t>(which), u, v}, there);
    emission = there.emission * there.lights_up;
  }
  return {direction, emission, weights.chance(chosen) * square / (cosine * lamp.area_m2)};
}

/// Draws a headlight. `strengths`: sum over all headlights at `from_m`. `distance_m`: to it, set where there is light.
inline LightSample draw_headlight(const World& world, float strengths, const glm::vec3& from_m, float time,
                                  PathRandom& random, float& distance_m) {
  if (!(strengths > 0.0f)) return {};
  const HeadlightRow& headlights = world.headlights();
  const DrawnHeadlight drawn = headlights.drawn(from_m, time, random.uniform(), strengths);
  const glm::vec3 way = headlights.position_m(drawn.which, time) - from_m;
  distance_m = glm::length(way);
  return {way / std::max(distance_m, 1e-6f), light::headlight_color * drawn.strength, drawn.strength / strengths};
}

}  // namespace septet::raytrace
