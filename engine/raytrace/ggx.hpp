#pragma once
/// Rough surfaces as microfacets: the GGX distribution (engine/light/microfacets.hpp) with Smith's masking (Walter et
/// al., "Microfacet Models for Refraction through Rough Surfaces", 2007; Heitz, "Understanding the Masking-Shadowing
/// Function", 2014). Directions are unit vectors in the surface's frame, z its normal; `alpha` is the square of the
/// roughness.

#include "engine/raytrace/directions.hpp"

namespace septet::raytrace {

/// Smith's Λ: masking alone is 1/(1 + Λ(v)), masking and shadowing 1/(1 + Λ(v) + Λ(l)).
inline float smith_lambda(const glm::vec3& v, float alpha) {
  const float z2 = std::max(v.z * v.z, 1e-12f);
  return 0.5f * (std::sqrt(1.0f + alpha * alpha * (1.0f - z2) / z2) - 1.0f);
}

/// Draws a microfacet's normal visible from `v` (Heitz, "Sampling the GGX Distribution of Visible Normals", 2018). Its
/// density is max(0, v·h) D(h) / ((1 + Λ(v)) v.z).
inline glm::vec3 visible_normal(const glm::vec3& v, float alpha, const glm::vec2& random) {
  const glm::vec3 stretched = glm::normalize(glm::vec3(alpha * v.x, alpha * v.y, v.z));
  const Frame frame(stretched);
  const float radius = std::sqrt(random.x), azimuth_rad = 2.0f * pi * random.y;
  const float x = radius * std::cos(azimuth_rad), s = 0.5f * (1.0f + stretched.z);
  // Horizontal axis `level` of the disc: then half of the disc is squeezed as the projection does.
  const glm::vec3 level =
      stretched.z < 0.9999f ? glm::normalize(glm::vec3(-stretched.y, stretched.x, 0.0f)) : frame.across;
  const glm::vec3 upward = glm::cross(stretched, level);
  const float y = (1.0f - s) * std::sqrt(std::max(0.0f, 1.0f - x * x)) + s * radius * std::sin(azimuth_rad);
  const float z = std::sqrt(std::max(0.0f, 1.0f - x * x - y * y));
  const glm::vec3 n = x * level + y * upward + z * stretched;
  return glm::normalize(glm::vec3(alpha * n.x, alpha * n.y, std::max(1e-6f, n.z)));
}

}  // namespace septet::raytrace
