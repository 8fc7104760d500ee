#pragma once
/// One traffic driver: car following by the Intelligent Driver Model, lane changes by MOBIL.
///
/// Sources: M. Treiber, A. Hennecke, D. Helbing, "Congested traffic states in empirical observations and microscopic
/// simulations", Phys. Rev. E 62 (2000), eqs. 2–4 (IDM); A. Kesting, M. Treiber, D. Helbing, "General lane-changing
/// model MOBIL for car-following models", Transp. Res. Rec. 1999 (2007), eqs. 2–5; A. Kesting, M. Treiber, D. Helbing,
/// "Enhanced intelligent driver model to access the impact of driving strategies on traffic capacity", Phil. Trans. R.
/// Soc. A 368 (2010), section 3 (response to cut-ins). Pure functions; SI units.

#include <limits>

namespace septet::traffic {

/// IDM. The symbols of the paper stand in the comments.
struct FollowingParameters {
  double desired_speed_mps = 33.3;        ///< v0
  double time_gap_s = 1.4;                ///< T
  double acceleration_mps2 = 1.5;         ///< a
  double comfortable_braking_mps2 = 2.5;  ///< b
  double standstill_gap_m = 2.0;          ///< s0
};

/// MOBIL.
struct LaneChangeParameters {
  double politeness = 0.2;            ///< p
  double threshold_mps2 = 0.2;        ///< Δa_th
  double keep_right_mps2 = 0.15;      ///< Δa_bias: towards the outer lanes.
  double largest_braking_mps2 = 3.0;  ///< b_safe: limit of the braking that a change may force on the follower.
  double duration_s = 4.5;            ///< From lane to lane, at speed.
};

struct Driver {
  FollowingParameters following;
  LaneChangeParameters lane_change;
  double reaction_s = 1.0;  ///< From hearing an emergency vehicle to making way.
};

/// Between a timid (0) and an aggressive (1) driver; 0.5 is `middle` itself. Desired speed 0.9 to 1.15 times, T 1.8 to
/// 0.8 s and so on are the span that traffic-simulation practice gives; each is applied as a factor to the middle
/// driver, geometrically, so that a lorry's driver keeps being one.
Driver with_temperament(const Driver& middle, double temperament);

/// A driver with worse manners, by a step: follows closer, cuts in where others have to brake, keeps right less and
/// makes way later. Six steps stay within the bounds of `FollowingLaw` and lane changes.
Driver with_worse_manners(const Driver& driver);

/// The hardest braking of any vehicle.
inline constexpr double hardest_braking_mps2 = 9.0;
inline constexpr double no_leader = std::numeric_limits<double>::infinity();

/// The speed at which this gap is kept with no acceleration: the root of eq. 3, to 1e-12 m/s.
double idm_equilibrium_speed(const FollowingParameters& driver, double gap_m);

/// String stability of equal drivers who follow each other at this gap, in 1/s²: positive where a disturbance fades
/// from vehicle to vehicle, negative where it grows into stop-and-go waves. (½ f_v + f_Δv) f_v − f_s of the law f(s, v,
/// Δv) in equilibrium (Treiber and Kesting, "Traffic Flow Dynamics", 2013, section 15.4).
double idm_stability_margin(const FollowingParameters& driver, double gap_m);

/// Acceleration of one who goes no faster than he can stop within what he sees, by his comfortable braking after a reaction of a second; braking is at
/// most twice the comfortable.
double acceleration_within_sight(const FollowingParameters& driver, double speed_mps, double seen_m);

/// IDM, eqs. 3 and 4, with its constants computed once, for the loop over all vehicles.
struct FollowingLaw {
  double inverse_desired_speed = 1.0, time_gap_s = 1.0, acceleration_mps2 = 1.0;
  double standstill_gap_m = 2.0, half_inverse_root_ab = 1.0;
  double comfortable_braking_mps2 = 2.0;

  FollowingLaw() = default;
  explicit FollowingLaw(const FollowingParameters& driver);

  /// Acceleration, m/s², behind a leader `gap_m` ahead; infinite `gap_m` without one.
  double acceleration(double speed_mps, double leader_speed_mps, double gap_m) const {
    const double ratio = speed_mps * inverse_desired_speed;
    const double ratio2 = ratio * ratio;
    const double dynamic = speed_mps * (time_gap_s + (speed_mps - leader_speed_mps) * half_inverse_root_ab);
    const double wanted = standstill_gap_m + (dynamic > 0.0 ? dynamic : 0.0);
    const double tight = wanted / (gap_m > 0.1 ? gap_m : 0.1);
    const double a = acceleration_mps2 * (1.0 - ratio2 * ratio2 - tight * tight);
    return a > -hardest_braking_mps2 ? a : -hardest_braking_mps2;
  }

  /// Braking of a driver for whom the intelligent driver model gives `idm_mps2`: the model takes a gap that a cut-in
  /// has shortened for an emergency. People count on the leader not to brake harder than now, and take longer to open
  /// the gap: from the braking that just avoids a collision (the constant-acceleration heuristic) on, the model's
  /// braking is limited to the comfortable one. In equilibrium, and to first order about it, both are the same. Unlike
  /// in the paper, a leader's acceleration is not counted on, and tanh is its Padé approximant, good to 0.03.
  double with_coolness(double idm_mps2, double speed_mps, double leader_speed_mps, double leader_acceleration_mps2,
                       double gap_m) const {
    if (idm_mps2 >= 0.0) return idm_mps2;
    constexpr double coolness = 0.99;
    const double gap = gap_m > 0.1 ? gap_m : 0.1;
    const double leader_mps2 = leader_acceleration_mps2 < 0.0 ? leader_acceleration_mps2 : 0.0;
    const double closing = speed_mps - leader_speed_mps, free = -2.0 * gap * leader_mps2;
    const double just_enough = leader_speed_mps * closing < free
                                   ? speed_mps * speed_mps * leader_mps2 / (leader_speed_mps * leader_speed_mps + free)
                                   : leader_mps2 - (closing > 0.0 ? closing * closing / (2.0 * gap) : 0.0);
    const double beyond = (idm_mps2 - just_enough) / comfortable_braking_mps2;
    if (beyond >= 0.0) return idm_mps2;
    const double square = beyond * beyond;
    const double tanh = beyond > -3.0 ? beyond * (27.0 + square) / (27.0 + 9.0 * square) : -1.0;
    const double a = (1.0 - coolness) * idm_mps2 + coolness * (just_enough + comfortable_braking_mps2 * tanh);
    return a > -hardest_braking_mps2 ? a : -hardest_braking_mps2;
  }
};

}  // namespace septet::traffic
