#pragma once
/// Searle's band: the speeds from which a throw over a known way can have come, whatever its angle.
///
/// While a body flies, falls and slides with friction at its limit, v_x + mu v_z falls by mu g a second, whatever it
/// bounces off. So a body that leaves at V under an angle t and sinks by H until it rests comes over
/// S = (V (cos t + mu sin t))^2 / (2 mu g) + mu H, and cos t + mu sin t is 1 to sqrt(1 + mu^2) for all angles that are
/// not downwards or steeper than twice atan(mu). With H = 0 it is Searle 1983 (SAE 831622), of throws that start and
/// end at one height; who is struck standing starts with his mass centre at 0.98 m and ends lying, 0.56 m further at
/// mu = 0.66: little beside a throw over 20 m and a seventh of one over 4 m.

#include <cmath>

#include <glm/geometric.hpp>

#include "engine/math/gravity.hpp"
#include "engine/math/rigid_transform.hpp"

namespace septet::searle {

inline constexpr double ground_friction = 0.66;  ///< Of clothed bodies on asphalt.

/// Way in plan of a body that nothing but the ground touches any more, from its velocity and how far it sinks.
inline double way_alone_m(const Vec3& velocity_mps, double sinks_m) {
  const double lost_mps = glm::length(Vec2(velocity_mps)) + ground_friction * velocity_mps.z;
  return lost_mps * lost_mps / (2.0 * ground_friction * gravity_mps2) + ground_friction * sinks_m;
}

struct Band {
  double least_mps, most_mps;
};

/// `thrown_m`: way of the mass centre in plan, from the touch to rest. `sinks_m`: its height at the touch less at rest.
inline Band band(double thrown_m, double sinks_m) {
  const double most_mps = std::sqrt(2.0 * ground_friction * gravity_mps2 * (thrown_m - ground_friction * sinks_m));
  return {most_mps / std::sqrt(1.0 + ground_friction * ground_friction), most_mps};
}

}  // namespace septet::searle
