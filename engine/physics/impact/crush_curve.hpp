#pragma once
/// How two bodies crush each other: the deceleration of their approach against the depth of their overlap.
///
/// A body of mass m presses like a spring of stiffness m ω², which past its crumple zone is `harder_times` as stiff
/// (engine/world/crush.toml; McHenry's SMAC, 1973; Huang 2002, Vehicle Crash Mechanics, ch. 4); what stands fast does
/// not give. Two bodies press in series, with the same force. Divided by the mass of the approach, m1 m2/(m1 + m2)
/// in line, and less where the contact is off the centres and fewer members carry it, that force is a deceleration
/// which depends on masses and frequencies alone: a(d), piecewise straight, at most three pieces. The approach at V
/// ends where ∫ a dd = V²/2; each body's part of that depth is its crush. Two equal cars, or a car and a wall, both
/// with ω: V/ω after π/2ω = 67 ms, and less time where the crumple zones are used up.

#include <array>
#include <cstddef>

#include "engine/world/vehicle_body.hpp"

namespace septet::impact {

/// Stiffness of one body for its mass.
struct Stiffness {
  double mass_kg = 0.0;  ///< Infinite: it does not give.
  Crush crush{};
};

/// The curve from `depth_m` on.
struct CrushPiece {
  double depth_m = 0.0;
  double deceleration_mps2 = 0.0;  ///< There.
  double steepness_ps2 = 0.0;      ///< Growth of the deceleration by depth, 1/s².
};

struct CrushCurve {
  std::array<CrushPiece, 3> pieces;
  std::size_t count = 0;
};

/// At least one of the two must have a finite mass.
CrushCurve crush_curve(const Stiffness& first, const Stiffness& second);

/// The curve as it goes on from `depth_m`: for bodies that are crushed so far already.
CrushCurve beyond(const CrushCurve& curve, double depth_m);

/// Depth at which an approach at `speed_mps` ends.
double depth_m(const CrushCurve& curve, double speed_mps);
/// Speed of approach that ends at this depth: the inverse.
double speed_mps(const CrushCurve& curve, double depth_m);
/// Deceleration at this depth.
double deceleration_mps2(const CrushCurve& curve, double depth_m);
/// Time in which an approach at `speed_mps` ends.
double compression_s(const CrushCurve& curve, double speed_mps);

/// The approach as it is `time_s` after the touch, at most compression_s.
struct Approach {
  double depth_m = 0.0, speed_mps = 0.0;
};
Approach approach_at(const CrushCurve& curve, double speed_mps, double time_s);

/// Crush of either body where both overlap by `depth_m`.
struct CrushShares {
  double first_m = 0.0, second_m = 0.0;
};
CrushShares crush_shares(const Stiffness& first, const Stiffness& second, double depth_m);

}  // namespace septet::impact
