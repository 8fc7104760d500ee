#include "engine/physics/vehicle/sliding.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/math/gravity.hpp"

namespace septet::vehicle {
namespace {

constexpr double creep_mps = 0.05;  ///< Slower wheels are held by less than the whole friction.
constexpr double still_mps = 0.002, still_radps = 0.002;

}  // namespace

void slide(const LockedWheels& wheels, double dt_s, impact::Body& body) {
  const impact::Body before = body;
  for (const LockedWheel& wheel : wheels) {
    const Vec2 arm_m = turned(wheel.arm_m, before.heading_rad);
    const Vec2 slip_mps = impact::velocity_at(before, arm_m);
    const double most_ns = wheel.friction * wheel.load_share * body.mass_kg * gravity_mps2 * dt_s;
    impact::push(body, -most_ns / std::max(glm::length(slip_mps), creep_mps) * slip_mps, arm_m);
  }
  body.mass_centre_m += 0.5 * dt_s * (before.velocity_mps + body.velocity_mps);
  body.heading_rad += 0.5 * dt_s * (before.yaw_rate_radps + body.yaw_rate_radps);
}

void advance_sliding(const LockedWheels& wheels, double dt_s, impact::Body& body) {
  for (int i = 0; i < sliding_steps; ++i) slide(wheels, dt_s / sliding_steps, body);
  come_to_rest(body);
}

void come_to_rest(impact::Body& body) {
  if (glm::length(body.velocity_mps) < still_mps && std::abs(body.yaw_rate_radps) < still_radps) {
    body.velocity_mps = Vec2(0.0);
    body.yaw_rate_radps = 0.0;
  }
}

}  // namespace septet::vehicle
