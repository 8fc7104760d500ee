#pragma once
/// Continuation of a ray at a surface: origin of the next ray, and reflection or refraction at a clear body. For paths
/// from the eye and from lights.

#include <algorithm>
#include <cmath>

#include "engine/light/fresnel.hpp"
#include "engine/light/ice_optics.hpp"
#include "engine/raytrace/world.hpp"

namespace septet::raytrace {

inline constexpr int most_sheets_passed = 64;  ///< Sheets of glass, on one edge.

/// Margin above the rounding error of a position, or of eight.
template <typename Vector>
inline auto margin_m(const Vector& position_m) {
  return 1e-4f + 2e-6f * larger(larger(magnitude(position_m.x), magnitude(position_m.y)), magnitude(position_m.z));
}

/// Position moved off the surface by that margin.
template <typename Vector>
inline Vector beside(const Vector& position_m, const Vector& normal) {
  return position_m + normal * margin_m(position_m);
}

/// Reflects or refracts at a clear body's surface, drawn by Fresnel's share. The ray's time stays.
inline Ray enter_or_leave(const SurfacePoint& point, const Ray& ray, PathRandom& random) {
  const glm::vec3& n = point.surface.normal;
  const float cosine = std::clamp(-glm::dot(n, ray.direction), 0.0f, 1.0f);
  const float eta = point.from_front ? 1.0f / point.index : point.index;
  Ray next;
  next.time = ray.time;
  if (random.uniform() < light::fresnel(cosine, eta)) {
    next.direction = glm::normalize(light::mirrored_way(ray.direction, n));
    next.origin_m = beside(point.position_m, point.flat_normal);
  } else {
    next.direction = glm::normalize(light::refracted(ray.direction, n, eta));
    next.origin_m = beside(point.position_m, -point.flat_normal);
  }
  return next;
}

/// Draws the side of a translucent sheet: half of the light that leaves comes from its other side. For that side
/// `direction`, the ray's, and the normals are mirrored.
inline void take_a_side(SurfacePoint& point, glm::vec3& direction, PathRandom& random) {
  if (random.uniform() < 0.5f) return;
  direction -= 2.0f * glm::dot(direction, point.flat_normal) * point.flat_normal;
  point.flat_normal = -point.flat_normal;
  point.surface.normal = -point.surface.normal;
}

/// Normal of the side on which this direction leads away from the surface; zero where it leads into it.
inline glm::vec3 side_towards(const SurfacePoint& point, const glm::vec3& direction) {
  const float out = glm::dot(direction, point.flat_normal);
  if (out > 0.0f) return point.flat_normal;
  return point.face_in_sheet && out < 0.0f ? -point.flat_normal : glm::vec3(0.0f);
}

}  // namespace septet::raytrace
