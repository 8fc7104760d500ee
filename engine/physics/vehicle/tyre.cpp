#include "engine/physics/vehicle/tyre.hpp"

#include <algorithm>
#include <cmath>

namespace septet::vehicle {
namespace {

constexpr double smallest_transport_mps = 1e-4;

/// Quadratic in load through zero, `at_nominal` and `at_double` (Hirschberg et al. 2007, eq. 4).
double over_load(double at_nominal, double at_double, double load_ratio) {
  const double bend = at_nominal - 0.5 * at_double;
  return load_ratio * (at_nominal + bend - bend * load_ratio);
}

double at_load(double at_nominal, double at_double, double load_ratio) {
  return at_nominal + (at_double - at_nominal) * (load_ratio - 1.0);
}

SlipCurve curve_at(const SlipCurve& nominal, const SlipCurve& twice, double load_ratio, double friction_ratio,
                   double firmness) {
  // The parabola holds up to two and a half times the nominal load: proportional from there.
  const double q = std::min(load_ratio, 2.5);
  const double beyond = load_ratio / q;
  const double slip_load = std::clamp(q, 0.2, 2.5);
  const double slip_scale = friction_ratio / firmness;  // The same force, at more slip.
  return {
      .slope_n = firmness * beyond * over_load(nominal.slope_n, twice.slope_n, q),
      .peak_slip = slip_scale * at_load(nominal.peak_slip, twice.peak_slip, slip_load),
      .peak_force_n = beyond * friction_ratio * over_load(nominal.peak_force_n, twice.peak_force_n, q),
      .sliding_slip = slip_scale * at_load(nominal.sliding_slip, twice.sliding_slip, slip_load),
      .sliding_force_n = beyond * friction_ratio * over_load(nominal.sliding_force_n, twice.sliding_force_n, q),
  };
}

double force_at(const SlipCurve& curve, double slip) {
  if (slip < curve.peak_slip) {
    const double part = slip / curve.peak_slip;
    return curve.slope_n * slip / (1.0 + part * (part + curve.slope_n * curve.peak_slip / curve.peak_force_n - 2.0));
  }
  if (slip < curve.sliding_slip) {
    const double part = (slip - curve.peak_slip) / (curve.sliding_slip - curve.peak_slip);
    return curve.peak_force_n - (curve.peak_force_n - curve.sliding_force_n) * part * part * (3.0 - 2.0 * part);
  }
  return curve.sliding_force_n;
}

/// The curve in the direction (cosine, sine) of normalised slip, whose unit is `unit` of plain slip.
SlipCurve join(const SlipCurve& x, const SlipCurve& y, Vec2 unit, Vec2 direction) {
  const auto mean = [&](double along, double across) {
    const double a = along * direction.x, b = across * direction.y;
    return std::sqrt(a * a + b * b);
  };
  return {
      .slope_n = mean(x.slope_n * unit.x, y.slope_n * unit.y),
      .peak_slip = mean(x.peak_slip / unit.x, y.peak_slip / unit.y),
      .peak_force_n = mean(x.peak_force_n, y.peak_force_n),
      .sliding_slip = mean(x.sliding_slip / unit.x, y.sliding_slip / unit.y),
      .sliding_force_n = mean(x.sliding_force_n, y.sliding_force_n),
  };
}

double trail(const LoadSensitiveTyre& tyre, double length_m, double friction_ratio, double lateral_slip) {
  const double zero = tyre.trail_zero_slip * friction_ratio;
  const double part = std::min(std::abs(lateral_slip) / zero, 1.0);
  // Falls to zero and stays a little negative past it, as the sliding patch's force moves in front of the middle.
  const double shape = (1.0 - part) * (1.0 + part - 2.0 * part * part) - 0.05 * part * part;
  return tyre.trail_over_length * length_m * shape;
}

}  // namespace

TyreForce load_sensitive_force(const TyreParameters& parameters, const TyreContact& contact) {
  const LoadSensitiveTyre& tyre = parameters.load_sensitive;
  const double load_ratio = contact.load_n / tyre.nominal_load_n;
  const double friction_ratio = std::max(contact.friction / parameters.reference_friction, 0.01);
  const SlipCurve x =
      curve_at(tyre.longitudinal_nominal, tyre.longitudinal_double, load_ratio, friction_ratio, contact.firmness);
  const SlipCurve y = curve_at(tyre.lateral_nominal, tyre.lateral_double, load_ratio, friction_ratio, contact.firmness);

  TyreForce result;
  result.transport_mps = std::abs(contact.rolling_mps) + smallest_transport_mps;
  result.slip = -contact.sliding_mps / result.transport_mps;
  // An inclined tyre pushes towards the side it leans to, as if it slipped a little.
  const Vec2 slip{result.slip.x, result.slip.y - tyre.camber_slip * contact.inclination_rad};

  const double force_slip_x = x.peak_force_n / x.slope_n, force_slip_y = y.peak_force_n / y.slope_n;
  const Vec2 unit{x.peak_slip / (x.peak_slip + y.peak_slip) + force_slip_x / (force_slip_x + force_slip_y),
                  y.peak_slip / (x.peak_slip + y.peak_slip) + force_slip_y / (force_slip_x + force_slip_y)};
  const Vec2 normalised = slip / unit;
  const double size = std::sqrt(normalised.x * normalised.x + normalised.y * normalised.y);
  result.stiffness_npm = contact.firmness * Vec2(tyre.longitudinal_stiffness_npm, tyre.lateral_stiffness_npm);
  result.damping_nspm = {tyre.longitudinal_damping_nspm, tyre.lateral_damping_nspm};
  if (size < 1e-12) {
    result.secant_n = {x.slope_n, y.slope_n};
    result.trail_m = trail(tyre, contact.length_m, friction_ratio, 0.0);
    return result;
  }
  const Vec2 direction = normalised / size;
  const double force = force_at(join(x, y, unit, direction), size);
  result.force_n = force * direction;
  result.secant_n = force / size / unit;
  result.trail_m = trail(tyre, contact.length_m, friction_ratio, slip.y);
  return result;
}

Vec2 relax(const TyreForce& steady, double most_force_n, double dt_s, Vec2& deflection_m) {
  Vec2 force_n{0.0};
  for (int i = 0; i < 2; ++i) {
    const double mobility = steady.transport_mps / (steady.damping_nspm[i] * steady.transport_mps + steady.secant_n[i]);
    const double before_m = deflection_m[i];
    deflection_m[i] =
        (before_m + dt_s * mobility * steady.force_n[i]) / (1.0 + dt_s * mobility * steady.stiffness_npm[i]);
    force_n[i] =
        steady.stiffness_npm[i] * deflection_m[i] + steady.damping_nspm[i] * (deflection_m[i] - before_m) / dt_s;
  }
  const double size_n = std::sqrt(force_n.x * force_n.x + force_n.y * force_n.y);
  if (size_n > most_force_n) {
    const double share = most_force_n / size_n;
    force_n *= share;
    deflection_m *= share;
  }
  return force_n;
}

}  // namespace septet::vehicle
