#include "engine/physics/impact/impulse.hpp"

#include <algorithm>
#include <cmath>

namespace septet::impact {
namespace {

/// What a unit impulse at the point changes of the relative velocity there.
struct Mobility {
  double nn = 0.0, tt = 0.0, nt = 0.0;

  void add(const Body& body, const Vec2& arm_m, const Vec2& normal) {
    const double n = cross(arm_m, normal), t = cross(arm_m, left_of(normal));
    nn += 1.0 / body.mass_kg + n * n / body.yaw_inertia_kgm2;
    tt += 1.0 / body.mass_kg + t * t / body.yaw_inertia_kgm2;
    nt += n * t / body.yaw_inertia_kgm2;
  }
};

}  // namespace

std::optional<Impulse> impulse_at(const Body& first, const Body& second, const Place& place, const Rule& rule) {
  Impulse impulse;
  impulse.first_arm_m = place.point_m - first.mass_centre_m;
  impulse.second_arm_m = place.point_m - second.mass_centre_m;
  const Vec2 tangent = left_of(place.normal);
  const Vec2 relative_mps = relative_velocity_at(first, second, place.point_m);
  impulse.closing_mps = glm::dot(relative_mps, place.normal);
  impulse.sliding_mps = glm::dot(relative_mps, tangent);
  impulse.stopped_mps = std::min(impulse.closing_mps, rule.most_stopped_mps);
  Mobility k;
  k.add(first, impulse.first_arm_m, place.normal);
  k.add(second, impulse.second_arm_m, place.normal);
  if (!(impulse.stopped_mps > 0.0) || !(k.nn > 0.0)) return std::nullopt;
  const double u_n = impulse.stopped_mps, u_t = impulse.sliding_mps;
  const double determinant = k.nn * k.tt - k.nt * k.nt;
  double normal_ns = (u_n * k.tt - u_t * k.nt) / determinant, tangential_ns = (u_t * k.nn - u_n * k.nt) / determinant;
  impulse.sticks = std::abs(tangential_ns) <= rule.friction * normal_ns;
  if (!impulse.sticks) {
    const double ratio = std::copysign(rule.friction, tangential_ns);
    normal_ns = u_n / (k.nn + ratio * k.nt);
    tangential_ns = ratio * normal_ns;
  }
  impulse.normal_ns = (1.0 + rule.restitution) * normal_ns;
  impulse.tangential_ns = (1.0 + rule.restitution) * tangential_ns;
  impulse.on_second_ns = impulse.normal_ns * place.normal + impulse.tangential_ns * tangent;
  return impulse;
}

void exchange(const Impulse& impulse, double share, Body& first, Body& second) {
  push(first, -share * impulse.on_second_ns, impulse.first_arm_m);
  push(second, share * impulse.on_second_ns, impulse.second_arm_m);
}

}  // namespace septet::impact
