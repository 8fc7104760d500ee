#pragma once
/// The impulse of the closed form spread over the crush, and its ledger of energy.
///
/// In compression the closing speed falls from V to 0 along the crush curve (crush_curve.hpp), in restitution it turns
/// to −eV while the force falls off like a cosine from its peak a: that takes π e V/2a, and gives e²V²/a of the depth
/// back. The share of the impulse that has been given at any time is that by which the closing speed has changed:
/// (V − v)/(1+e)V. Direction and arms are held as they were at the touch, so the whole pulse gives each body the
/// impulse and the turn of the closed form to rounding, however fast the bodies turn meanwhile; a force that followed
/// the moving point would miss it by some per cent. Momentum, and the angular momentum about the point with its held
/// arms, are kept in every step.
///
/// The bodies' own steps are long against a pulse: at 60 m/s half a step's delay would sink a car by decimetres. So a
/// pulse also moves them by what it moves them within the step, its time integral, and the overlap is that of the law
/// whatever the step.
///
/// A pulse is plain data: the caller keeps it, saves it, and advances it after each step of the bodies.

#include "engine/physics/impact/crush_curve.hpp"
#include "engine/physics/impact/impulse.hpp"

namespace septet::impact {

/// Energies of an impact so far, J, each summed by itself from the bodies' motion: what they have lost; the work of
/// the normal force, which has crushed them (less what sprang back); and that of friction. In stick the tangential
/// force may do work on the surfaces' sliding, and friction_j be negative.
struct Ledger {
  double kinetic_j = 0.0, crush_j = 0.0, friction_j = 0.0;
};

inline Ledger difference(const Ledger& later, const Ledger& earlier) {
  return {later.kinetic_j - earlier.kinetic_j, later.crush_j - earlier.crush_j, later.friction_j - earlier.friction_j};
}

struct Pulse {
  Impulse impulse;
  Vec2 normal{1.0, 0.0};
  CrushCurve curve;
  double restitution = 0.0;
  double compression_s = 0.0, restitution_s = 0.0;  ///< Durations.
  double most_depth_m = 0.0;                        ///< Overlap at the end of compression: both crushes.
  double age_s = 0.0;                               ///< Since the touch; none of the impulse has been given at 0.
  Ledger ledger;
};

Pulse pulse_of(const Impulse& impulse, const Vec2& normal, const CrushCurve& curve, double restitution);

inline double duration_s(const Pulse& pulse) { return pulse.compression_s + pulse.restitution_s; }
inline bool is_over(const Pulse& pulse) { return pulse.age_s >= duration_s(pulse); }

/// Share of the impulse given until `age_s`: 0 to 1.
double share_at(const Pulse& pulse, double age_s);

/// Overlap along the normal at `age_s`, as far as the pulse alone moves the bodies.
double overlap_at_m(const Pulse& pulse, double age_s);

/// Mean of share_at from 0 to `age_s`, times age_s: how far the pulse has moved the bodies, in units of their speeds'
/// whole change.
double share_integral_s(const Pulse& pulse, double age_s);

/// Gives both bodies what is due in the `dt_s` from the pulse's age on, and adds it to its ledger; returns that impulse
/// on the second body. Both have moved through this time by their motion before it; they are moved on, and turned, by
/// what the impulse adds to that. Of a pulse that is over, nothing.
Vec2 advance_pulse(double dt_s, Pulse& pulse, Body& first, Body& second);

}  // namespace septet::impact
