#pragma once
/// Poses of people's limbs: a walking cycle, legs on pedals, a body that was thrown. Angles about the left axis (y);
/// positive swings a hanging limb forward.
///
/// The phase is that of the distance gone (Participant::wheel_spin_rad), so that every picture of an instant shows the
/// same step, and a standing person stands still. Walking is given by the feet: from the strike of the heel to the
/// toe's leave a foot is fixed to the ground by its heel, then by its sole, then by its toe, and goes back under the
/// hip by as much as the hip goes on. Hip and knee follow by the law of cosines. Shares of the cycle and angles are
/// rounded from gait tables (stance 0.6, heel up from 0.3 to 0.4, hip's rise 4 to 5 cm: J. Perry, Gait Analysis, 1992;
/// M. P. Murray et al., 1964).

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace septet {

/// Stride of an adult: two steps.
inline constexpr double stride_m = 1.4;

/// Joints of a person of 1.75 m, m: from joint to joint, and the heights of ankle, hip and shoulder of who stands.
inline constexpr double thigh_m = 0.41, shin_m = 0.41, ankle_height_m = 0.08;
inline constexpr double hip_height_m = thigh_m + shin_m + ankle_height_m, shoulder_height_m = 1.40;

/// Points of the sole from the ankle's plumb line, on which a foot turns.
inline constexpr double heel_behind_m = 0.06, toe_ahead_m = 0.15;

/// Dimensions on a bicycle: the bottom bracket from the hip, forward and down, and the crank.
inline constexpr double bracket_ahead_m = 0.20, bracket_below_m = 0.60, crank_m = 0.165;

struct LegAngles {
  double thigh_rad = 0.0;  ///< From hanging straight down.
  double knee_rad = 0.0;   ///< Angle of the shin against the thigh, backwards.
};

/// Angles of thigh and shin from the hip to an ankle ahead of it and below it.
inline LegAngles leg_to(double ahead_m, double below_m) {
  const double reach = std::clamp(std::hypot(ahead_m, below_m), 0.1, 0.999 * (thigh_m + shin_m));
  const double knee =
      std::numbers::pi - std::acos((thigh_m * thigh_m + shin_m * shin_m - reach * reach) / (2.0 * thigh_m * shin_m));
  const double at_hip = std::acos((thigh_m * thigh_m + reach * reach - shin_m * shin_m) / (2.0 * thigh_m * reach));
  return {std::atan2(ahead_m, below_m) + at_hip, knee};
}

/// Share of the gait's swing at this speed: 0 for a standing person.
inline double gait_share(double speed_mps) { return std::clamp(speed_mps / 0.5, 0.0, 1.0); }

namespace gait {

/// Shares of the cycle from the strike of the heel on: the foot is flat between the first two, the toe leaves at the
/// third.
inline constexpr double flat_from = 0.06, flat_until = 0.36, toe_leaves = 0.56;
/// The ankle of a flat foot from the hip as the heel strikes, and the foot's angles there and as the toe leaves.
inline constexpr double strike_ahead_m = 0.30, strike_rad = -0.10, leave_rad = 0.90;

}  // namespace gait

/// A foot in the frame of a person who walks at an even speed: x from the hip's plumb line, z from the ground.
struct FootPose {
  double ahead_m = 0.0, above_m = ankle_height_m;  ///< Of the ankle.
  double pitch_rad = 0.0;                          ///< Of the sole, positive: the heel is up.
};

/// The ankle of a foot that is turned about a point of its sole, which lies on the ground.
inline FootPose foot_about(double point_ahead_m, double point_from_ankle_m, double pitch_rad) {
  const double c = std::cos(pitch_rad), s = std::sin(pitch_rad);
  return {point_ahead_m - point_from_ankle_m * c + ankle_height_m * s, point_from_ankle_m * s + ankle_height_m * c,
          pitch_rad};
}

/// Foot of the left leg; its heel strikes at phase 0. The right leg is half a cycle behind.
inline FootPose walking_foot(double phase_rad) {
  using namespace gait;
  double cycle = phase_rad / (2.0 * std::numbers::pi);
  cycle -= std::floor(cycle);
  const auto standing = [](double at) {
    const double flat_m = strike_ahead_m - at * stride_m;
    if (at < flat_from) return foot_about(flat_m - heel_behind_m, -heel_behind_m, strike_rad * (1.0 - at / flat_from));
    const double heel = std::max(0.0, (at - flat_until) / (toe_leaves - flat_until));
    return foot_about(flat_m + toe_ahead_m, toe_ahead_m, leave_rad * heel * heel);
  };
  if (cycle < toe_leaves) return standing(cycle);
  // In the air: cubics in the share of the swing that begin and end with the places and, along the way, the speeds of
  // stance; the heel comes down quickly, lest it brush the ground.
  const FootPose from = standing(toe_leaves), to = standing(0.0);
  const double u = (cycle - toe_leaves) / (1.0 - toe_leaves), v = 1.0 - u;
  const double back_m = -stride_m * (1.0 - toe_leaves), lift_m = 0.42, sinks_m = 0.06;
  const double landed = u * u * (3.0 - 2.0 * u);
  return {from.ahead_m + (to.ahead_m - from.ahead_m) * landed - u * u * v * back_m,
          to.above_m + v * v * (from.above_m - to.above_m + lift_m * u) + sinks_m * u * v,
          from.pitch_rad + (to.pitch_rad - from.pitch_rad) * landed + 0.8 * u * v * v};
}

/// Height of the hips: highest above the foot that stands, lowest between two steps.
inline double walking_hip_m(double phase_rad, double share) {
  const double foot_below = 2.0 * std::numbers::pi * gait::strike_ahead_m / stride_m;
  return hip_height_m - share * (0.034 - 0.022 * std::cos(2.0 * (phase_rad - foot_below)));
}

/// A leg of a person who walks, with the foot's own angle.
struct WalkingLeg {
  LegAngles angles;
  double foot_pitch_rad = 0.0;
};
inline WalkingLeg walking_leg(double phase_rad, double share) {
  const FootPose foot = walking_foot(phase_rad);
  const double above_m = ankle_height_m + share * (foot.above_m - ankle_height_m);
  return {leg_to(share * foot.ahead_m, walking_hip_m(phase_rad, share) - above_m), share * foot.pitch_rad};
}
/// The arm goes against the leg of its side.
inline double walking_arm_rad(double phase_rad, double share) { return -0.38 * share * std::cos(phase_rad); }

/// Angles from the hip to the pedal. 0: the pedal is on top; it turns forward.
inline LegAngles pedalling_leg(double crank_rad) {
  return leg_to(bracket_ahead_m + crank_m * std::sin(crank_rad), bracket_below_m - crank_m * std::cos(crank_rad));
}

/// Joints of a person who was thrown: they travel where a vehicle's wheel lifts do (Participant::wheel_lift_m), for a
/// person has none. 0: stretched. In rad: thighs left and right, knees left and right.
using ThrownJoints = std::array<double, 4>;

}  // namespace septet
