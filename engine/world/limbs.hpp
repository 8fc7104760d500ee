#pragma once
/// Poses of people's limbs: a walking cycle, and legs on pedals. Angles about the left axis (y); positive swings a
/// hanging limb forward.
///
/// The phase is that of the distance gone (Participant::wheel_spin_rad), so that every picture of an instant shows the
/// same step, and a standing person stands still. The cycle's swing of hip and knee is a fit by eye to gait tables (hip
/// +30° to −10°, knee to 60° in the swing: J. Perry, Gait Analysis, 1992), with two sines alone.

#include <algorithm>
#include <cmath>
#include <numbers>

namespace septet {

/// Stride of an adult: two steps.
inline constexpr double stride_m = 1.4;

/// Joints of a person of 1.75 m, m: hip and shoulder above the ground, and from joint to joint.
inline constexpr double hip_height_m = 0.90, shoulder_height_m = 1.40, thigh_m = 0.41, shin_m = 0.41;

/// Dimensions on a bicycle: the bottom bracket from the hip, forward and down, and the crank.
inline constexpr double bracket_ahead_m = 0.20, bracket_below_m = 0.60, crank_m = 0.165;

struct LegAngles {
  double thigh_rad = 0.0;  ///< From hanging straight down.
  double knee_rad = 0.0;   ///< Angle of the shin against the thigh, backwards.
};

/// Share of the gait's swing at this speed: 0 for a standing person.
inline double gait_share(double speed_mps) { return std::clamp(speed_mps / 0.8, 0.0, 1.0); }

/// The right leg and the left arm are half a cycle behind.
inline LegAngles walking_leg(double phase_rad, double share) {
  const double swing = std::sin(phase_rad), forwards = std::max(0.0, std::cos(phase_rad));
  return {share * (0.14 + 0.38 * swing), share * (0.12 + 0.75 * forwards * forwards)};
}
inline double walking_arm_rad(double phase_rad, double share) { return -0.42 * share * std::sin(phase_rad); }

/// Angles from the hip to the pedal: two links (the law of cosines). 0: the pedal is on top; it turns forward.
inline LegAngles pedalling_leg(double crank_rad) {
  const double ahead = bracket_ahead_m + crank_m * std::sin(crank_rad),
               below = bracket_below_m - crank_m * std::cos(crank_rad);
  const double reach = std::min(std::hypot(ahead, below), 0.999 * (thigh_m + shin_m));
  const double knee =
      std::numbers::pi - std::acos((thigh_m * thigh_m + shin_m * shin_m - reach * reach) / (2.0 * thigh_m * shin_m));
  const double at_hip = std::acos((thigh_m * thigh_m + reach * reach - shin_m * shin_m) / (2.0 * thigh_m * reach));
  return {std::atan2(ahead, below) + at_hip, knee};
}

}  // namespace septet
