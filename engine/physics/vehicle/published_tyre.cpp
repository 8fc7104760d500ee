#include <algorithm>
#include <cmath>

#include "engine/physics/vehicle/tyre.hpp"

// The formula has axes with y to the right and z down, as published; signs change once, at its entry.

namespace septet::vehicle {
namespace {

double sign(double x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0; }

double inner(double b, double e, double x) { return b * x - e * (b * x - std::atan(b * x)); }

double cosine_magic(double b, double c, double e, double x) { return std::cos(c * std::atan(inner(b, e, x))); }

struct Lateral {
  double force_n = 0.0, friction = 0.0;
};

double longitudinal_pure(const PublishedTyre& p, double scale, double load_n, double slip, double inclination) {
  const double friction = scale * p.p_dx1 * (1.0 - p.p_dx3 * inclination * inclination);
  const double b = p.p_kx1 / (p.p_cx1 * friction);
  return load_n * (friction * std::sin(p.p_cx1 * std::atan(inner(b, p.p_ex1, slip + p.p_hx1))) + p.p_vx1);
}

Lateral lateral_pure(const PublishedTyre& p, double scale, double load_n, double slip_angle, double inclination) {
  const double lean = std::abs(inclination), side = sign(inclination);
  const double friction = scale * p.p_dy1 * (1.0 - p.p_dy3 * inclination * inclination);
  const double b = p.p_ky1 / (p.p_cy1 * friction);
  const double angle = slip_angle + side * (p.p_hy1 + p.p_hy3 * lean);
  const double shift = side * (p.p_vy1 + p.p_vy3 * lean);
  return {load_n * (friction * std::sin(p.p_cy1 * std::atan(inner(b, p.p_ey1, angle))) + shift), friction};
}

double longitudinal_share(const PublishedTyre& p, double braking_slip, double slip_angle) {
  const double b = p.r_bx1 * std::cos(std::atan(p.r_bx2 * braking_slip));
  return cosine_magic(b, p.r_cx1, p.r_ex1, slip_angle + p.r_hx1) / cosine_magic(b, p.r_cx1, p.r_ex1, p.r_hx1);
}

double lateral_combined(const PublishedTyre& p, const Lateral& pure, double load_n, double braking_slip,
                        double slip_angle, double inclination) {
  const double b = p.r_by1 * std::cos(std::atan(p.r_by2 * (slip_angle - p.r_by3)));
  const double share =
      cosine_magic(b, p.r_cy1, p.r_ey1, braking_slip + p.r_hy1) / cosine_magic(b, p.r_cy1, p.r_ey1, p.r_hy1);
  const double shift = pure.friction * load_n * (p.r_vy1 + p.r_vy3 * inclination) *
                       std::cos(std::atan(p.r_vy4 * slip_angle)) *
                       std::sin(p.r_vy5 * std::atan(p.r_vy6 * braking_slip));
  return pure.force_n * share + shift;
}

}  // namespace

TyreForce published_force(const TyreParameters& tyre, const TyreContact& contact) {
  const PublishedTyre& p = tyre.magic_formula;
  const double scale = contact.friction / tyre.reference_friction;
  TyreForce result;
  result.transport_mps = std::abs(contact.forward_mps) + 1e-4;
  result.slip = -contact.sliding_mps / result.transport_mps;
  // Slip of a locked wheel is 1; at rest any creep would count as sliding, so the formula sees at most spinning.
  const double drive = std::clamp(result.slip.x, -1.0, 10.0);
  const double slip_angle = std::atan(result.slip.y);  // Already mirrored: slip has the sign opposite to velocity.
  const double inclination = contact.inclination_rad;

  const double pure_x = longitudinal_pure(p, scale, contact.load_n, drive, inclination);
  const Lateral pure_y = lateral_pure(p, scale, contact.load_n, slip_angle, inclination);
  result.force_n.x = pure_x * longitudinal_share(p, -drive, slip_angle);
  result.force_n.y = -lateral_combined(p, pure_y, contact.load_n, -drive, slip_angle, inclination);

  const Vec2 slope_n{p.p_kx1 * contact.load_n, std::abs(p.p_ky1) * contact.load_n};
  result.stiffness_npm = slope_n / p.relaxation_length_m;
  // Near zero slip the shifts would make the secant meaningless; the slope replaces it there.
  for (int i = 0; i < 2; ++i) {
    const double slip = std::abs(result.slip[i]);
    const bool small = slip * slope_n[i] < 0.5 * scale * p.p_dy1 * contact.load_n;
    result.secant_n[i] =
        small ? slope_n[i] : std::clamp(std::abs(result.force_n[i]) / slip, 1e-6 * slope_n[i], slope_n[i]);
  }
  return result;
}

}  // namespace septet::vehicle
