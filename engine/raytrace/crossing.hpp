#pragma once
/// What a ray does at a surface: where the next one begins, and how it enters or leaves a clear body. For paths from the eye and from lights.

#include <algorithm>
#include <cmath>

#include "engine/light/fresnel.hpp"
#include "engine/light/ice_optics.hpp"
#include "engine/raytrace/world.hpp"

namespace septet::raytrace {

inline constexpr int most_sheets_passed = 64;  ///< Of glass, on one edge.

/// More than a place is uncertain by, or eight are.
template <typename Vector>
inline auto margin_m(const Vector& position_m) {
  return 1e-4f + 2e-6f * larger(larger(magnitude(position_m.x), magnitude(position_m.y)), magnitude(position_m.z));
}

/// Beside the surface by that.
template <typename Vector>
inline Vector beside(const Vector& position_m, const Vector& normal) {
  return position_m + normal * margin_m(position_m);
}

/// At a clear body's surface: reflected or refracted, as Fresnel's share falls. The ray's time stays.
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

/// At a translucent sheet: half of the light that leaves comes from its other side. There the sheet is seen from that side, as `direction`, the
/// ray's, is turned.
inline void take_a_side(SurfacePoint& point, glm::vec3& direction, PathRandom& random) {
  if (random.uniform() < 0.5f) return;
  direction -= 2.0f * glm::dot(direction, point.flat_normal) * point.flat_normal;
  point.flat_normal = -point.flat_normal;
  point.surface.normal = -point.surface.normal;
}

/// The side of the surface on which this direction leads away from it; zero where it leads into it.
inline glm::vec3 side_towards(const SurfacePoint& point, const glm::vec3& direction) {
  const float out = glm::dot(direction, point.flat_normal);
  if (out > 0.0f) return point.flat_normal;
  return point.face_in_sheet && out < 0.0f ? -point.flat_normal : glm::vec3(0.0f);
}

}  // namespace septet::raytrace
