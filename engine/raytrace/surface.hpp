#pragma once
/// Scattering of light at a surface: a coloured diffuse base under a rough reflecting layer, with a clear coat over
/// both.
///
/// Light that a layer reflects does not reach the one below: the base is weighed with (1 − F) of both directions, which
/// is reciprocal and never returns more than came. Radiance is reflected on the side of `normal` alone.

#include "engine/raytrace/ggx.hpp"
#include "engine/raytrace/path_random.hpp"

namespace septet::raytrace {

struct Surface {
  glm::vec3 normal{0.0f, 0.0f, 1.0f};  ///< Unit, towards the viewer.
  glm::vec3 diffuse{0.0f};             ///< Albedo of the base.
  glm::vec3 f0{0.0f};                  ///< Reflectance of the layer head-on; black: there is no layer.
  float alpha = 1.0f;                  ///< Roughness² of the layer.
  float coat = 0.0f;                   ///< Share of the surface covered by a clear coat: lacquer, or water.
  float coat_f0 = 0.04f;               ///< Index 1.5; water has 0.02.
  float coat_alpha = 0.001f;
  /// Share of the mirroring of layer and coat that soot on them leaves; `diffuse` has lost it already.
  float mirrors = 1.0f;
};

/// True for a diffuse base alone.
inline bool is_rough(const Surface& surface) {
  return surface.coat <= 0.0f && surface.f0.x + surface.f0.y + surface.f0.z <= 0.0f;
}

struct Scattering {
  glm::vec3 value{0.0f};  ///< Bidirectional reflectance times the cosine, 1/sr.
  float pdf = 0.0f;       ///< Density with which `scatter` would have drawn the direction, 1/sr.
};

struct Scattered {
  glm::vec3 direction{0.0f};
  glm::vec3 weight{0.0f};  ///< value / pdf; black: the path ends.
  float pdf = 0.0f;
};

/// Directions: unit, away from the surface, to the viewer and to the light.
Scattering layered_scattering(const Surface& surface, const glm::vec3& to_viewer, const glm::vec3& to_light);
Scattered layered_scatter(const Surface& surface, const glm::vec3& to_viewer, PathRandom& random);

inline Scattering scattering(const Surface& surface, const glm::vec3& to_viewer, const glm::vec3& to_light) {
  if (!is_rough(surface)) return layered_scattering(surface, to_viewer, to_light);
  const float cosine = glm::dot(surface.normal, to_light);
  if (cosine <= 0.0f || glm::dot(surface.normal, to_viewer) <= 0.0f) return {};
  const float pdf = cosine * (1.0f / pi);
  return {surface.diffuse * pdf, pdf};
}
inline Scattered scatter(const Surface& surface, const glm::vec3& to_viewer, PathRandom& random) {
  if (!is_rough(surface)) return layered_scatter(surface, to_viewer, random);
  if (glm::dot(surface.normal, to_viewer) <= 0.0f) return {};
  const glm::vec3 l = cosine_direction(random.pair());
  return {Frame(surface.normal).to_world(l), surface.diffuse, l.z * (1.0f / pi)};
}

}  // namespace septet::raytrace
