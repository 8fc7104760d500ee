#pragma once
/// A rigid body in plan, as an impact sees it: its mass, its yaw inertia, its motion.
///
/// World frame, metres, yaw counter-clockwise. An infinite mass with an infinite inertia is a thing that stands fast: a
/// wall, a pole. Free of the scene: a car, a carton and a house are told apart by their numbers alone.

#include <cmath>

#include <glm/geometric.hpp>

#include "engine/math/plane_vector.hpp"

namespace septet::impact {

struct Body {
  double mass_kg = INFINITY;
  double yaw_inertia_kgm2 = INFINITY;  ///< About the vertical through the mass centre.
  Vec2 mass_centre_m{0.0};
  Vec2 velocity_mps{0.0};  ///< Of the mass centre.
  double yaw_rate_radps = 0.0;
  double heading_rad = 0.0;
};

/// Velocity of the body's material at `arm_m` from its mass centre.
inline Vec2 velocity_at(const Body& body, const Vec2& arm_m) {
  return body.velocity_mps + body.yaw_rate_radps * left_of(arm_m);
}

/// Velocity of the first body's material at a point relative to the second's.
inline Vec2 relative_velocity_at(const Body& first, const Body& second, const Vec2& point_m) {
  return velocity_at(first, point_m - first.mass_centre_m) - velocity_at(second, point_m - second.mass_centre_m);
}

/// Changes the body's motion by an impulse at `arm_m`; has no effect on what stands fast.
inline void push(Body& body, const Vec2& impulse_ns, const Vec2& arm_m) {
  body.velocity_mps += impulse_ns / body.mass_kg;
  body.yaw_rate_radps += cross(arm_m, impulse_ns) / body.yaw_inertia_kgm2;
}

/// Kinetic energy that the body has lost between two moments, J (negative: won): ½m(v² − v'²) + ½I(ω² − ω'²), as
/// products of difference and sum, so that a light push of a fast body keeps its digits. 0 for what stands fast.
inline double kinetic_loss_j(const Body& before, const Body& after) {
  double loss_j = 0.0;
  if (std::isfinite(before.mass_kg))
    loss_j += 0.5 * before.mass_kg *
              glm::dot(before.velocity_mps - after.velocity_mps, before.velocity_mps + after.velocity_mps);
  if (std::isfinite(before.yaw_inertia_kgm2))
    loss_j += 0.5 * before.yaw_inertia_kgm2 * (before.yaw_rate_radps - after.yaw_rate_radps) *
              (before.yaw_rate_radps + after.yaw_rate_radps);
  return loss_j;
}

}  // namespace septet::impact
