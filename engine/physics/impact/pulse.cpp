#include "engine/physics/impact/pulse.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace septet::impact {
namespace {

constexpr double quarter_rad = 0.5 * std::numbers::pi;

Vec2 relative_mps(const Impulse& impulse, const Body& first, const Body& second) {
  return velocity_at(first, impulse.first_arm_m) - velocity_at(second, impulse.second_arm_m);
}

/// Moves a body by an impulse's integral over time, `shift_ns2`.
void carry(Body& body, const Vec2& shift_ns2, const Vec2& arm_m) {
  body.mass_centre_m += shift_ns2 / body.mass_kg;
  body.heading_rad += cross(arm_m, shift_ns2) / body.yaw_inertia_kgm2;
}

}  // namespace

Pulse pulse_of(const Impulse& impulse, const Vec2& normal, const CrushCurve& curve, double restitution) {
  Pulse pulse;
  pulse.impulse = impulse;
  pulse.normal = normal;
  pulse.curve = curve;
  pulse.restitution = restitution;
  pulse.compression_s = compression_s(curve, impulse.stopped_mps);
  pulse.most_depth_m = depth_m(curve, impulse.stopped_mps);
  pulse.restitution_s = quarter_rad * restitution * impulse.stopped_mps / deceleration_mps2(curve, pulse.most_depth_m);
  return pulse;
}

double share_at(const Pulse& pulse, double age_s) {
  if (age_s <= 0.0) return 0.0;
  if (age_s >= duration_s(pulse)) return 1.0;
  const double e = pulse.restitution, v = pulse.impulse.stopped_mps;
  if (age_s < pulse.compression_s) return (1.0 - approach_at(pulse.curve, v, age_s).speed_mps / v) / (1.0 + e);
  const double phase = quarter_rad * (age_s - pulse.compression_s) / pulse.restitution_s;
  return (1.0 + e * std::sin(phase)) / (1.0 + e);
}

double overlap_at_m(const Pulse& pulse, double age_s) {
  if (age_s <= 0.0) return 0.0;
  if (age_s < pulse.compression_s) return approach_at(pulse.curve, pulse.impulse.stopped_mps, age_s).depth_m;
  if (pulse.restitution_s <= 0.0) return pulse.most_depth_m;
  const double phase = quarter_rad * std::min(1.0, (age_s - pulse.compression_s) / pulse.restitution_s);
  const double back_mps = pulse.restitution * pulse.impulse.stopped_mps;
  return pulse.most_depth_m - back_mps * pulse.restitution_s / quarter_rad * (1.0 - std::cos(phase));
}

double share_integral_s(const Pulse& pulse, double age_s) {
  // The overlap is ∫ V (1 − (1+e) share) dt.
  const double last_s = std::clamp(age_s, 0.0, duration_s(pulse)), v = pulse.impulse.stopped_mps;
  return (v * last_s - overlap_at_m(pulse, last_s)) / ((1.0 + pulse.restitution) * v) + std::max(0.0, age_s - last_s);
}

Vec2 advance_pulse(double dt_s, Pulse& pulse, Body& first, Body& second) {
  const double from_s = pulse.age_s, share_before = share_at(pulse, from_s);
  const double share = share_at(pulse, from_s + dt_s) - share_before;
  pulse.age_s += dt_s;
  if (share <= 0.0) return Vec2(0.0);
  const double carried_s = share_integral_s(pulse, pulse.age_s) - share_integral_s(pulse, from_s) - share_before * dt_s;
  carry(first, -carried_s * pulse.impulse.on_second_ns, pulse.impulse.first_arm_m);
  carry(second, carried_s * pulse.impulse.on_second_ns, pulse.impulse.second_arm_m);
  const Body first_before = first, second_before = second;
  const Vec2 before_mps = relative_mps(pulse.impulse, first, second);
  exchange(pulse.impulse, share, first, second);
  const Vec2 mean_mps = 0.5 * (before_mps + relative_mps(pulse.impulse, first, second));
  pulse.ledger.kinetic_j += kinetic_loss_j(first_before, first) + kinetic_loss_j(second_before, second);
  pulse.ledger.crush_j += share * pulse.impulse.normal_ns * glm::dot(mean_mps, pulse.normal);
  pulse.ledger.friction_j += share * pulse.impulse.tangential_ns * glm::dot(mean_mps, left_of(pulse.normal));
  return share * pulse.impulse.on_second_ns;
}

}  // namespace septet::impact
