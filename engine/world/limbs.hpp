#pragma once
/// Poses of people's limbs: a walking cycle, legs on pedals, a body that was thrown. Angles about the left axis (y);
/// positive swings a hanging limb forward.
///
/// The phase travels in Participant::wheel_spin_rad, so that every picture of an instant shows the same step; its rate
/// tells the speed, and so the stride. Walking is given by the feet: from the strike of the heel to the toe's leave a
/// foot is fixed to the ground by its heel, then by its sole, then by its toe, and goes back under the hip by as much as
/// the hip goes on, along the curve of the way. Hip and knee follow by the law of cosines. Slow steps are the same in
/// small, so that who stands has both feet side by side; fast ones have a stance no longer than a brisk walk's, and so a
/// flight between two of them. Shares of the cycle and angles are rounded from gait tables (stance 0.6, heel up from 0.3
/// to 0.4, hip's rise 4 to 5 cm: J. Perry, Gait Analysis, 1992; M. P. Murray et al., 1964).

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace septet {

/// Strides a second (two steps each) at a speed: the length of a step is 0.0065 m for each step a minute, walking and
/// running (D. W. Grieve and R. J. Gear, Ergonomics 9, 1966).
inline double strides_hz(double speed_mps) { return std::sqrt(std::abs(speed_mps) / 1.56); }
/// The stride of so many a second; strides_hz(f · stride_m(f)) = f.
inline double stride_m(double strides_per_s) { return 1.56 * strides_per_s; }

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

namespace gait {

/// The walk of this stride, with the shares of its cycle from the strike of the heel on: the foot is flat between the
/// first two, the toe leaves at the third.
inline constexpr double usual_stride_m = 1.4, flat_from = 0.06, flat_until = 0.36, toe_leaves = 0.56;
/// Longer strides have the stance of this one.
inline constexpr double longest_stance_stride_m = 1.48;
/// The ankle of a flat foot from the hip as the heel strikes, and the foot's angles there and as the toe leaves.
inline constexpr double strike_ahead_m = 0.30, strike_rad = -0.10, leave_rad = 0.90;

}  // namespace gait

/// How a stride differs from the usual one.
struct Gait {
  double stride_m = gait::usual_stride_m;

  /// Way for which a foot is on the ground, and the hip's ups and downs, as a multiple of the usual.
  double size() const { return std::min(stride_m, gait::longest_stance_stride_m) / gait::usual_stride_m; }
  /// Angles of feet and arms likewise.
  double swing() const { return std::min(1.0, size()); }
  /// The stance's share of the cycle, likewise.
  double stance() const { return std::min(1.0, gait::longest_stance_stride_m / std::max(stride_m, 1e-6)); }
};

/// A foot in the frame of a person who walks at an even speed: x from the hip's plumb line, z from the ground.
struct FootPose {
  double ahead_m = 0.0, above_m = ankle_height_m;  ///< Of the ankle.
  double pitch_rad = 0.0;                          ///< Of the sole, positive: the heel is up.
  double flat_ahead_m = 0.0;  ///< Of the ankle of this foot, flat on the same ground: it goes back as the hip goes on.
};

/// The ankle of a foot that is turned about a point of its sole, which lies on the ground.
inline FootPose foot_about(double flat_ahead_m, double point_from_ankle_m, double pitch_rad) {
  const double c = std::cos(pitch_rad), s = std::sin(pitch_rad);
  return {flat_ahead_m + point_from_ankle_m * (1.0 - c) + ankle_height_m * s,
          point_from_ankle_m * s + ankle_height_m * c, pitch_rad, flat_ahead_m};
}

/// Foot of the left leg; its heel strikes at phase 0. The right leg is half a cycle behind.
inline FootPose walking_foot(double phase_rad, const Gait& gait) {
  using namespace gait;
  double cycle = phase_rad / (2.0 * std::numbers::pi);
  cycle -= std::floor(cycle);
  const auto standing = [&](double at) {
    const double flat_m = strike_ahead_m * gait.size() - at * gait.stride_m, usual = at / gait.stance();
    if (usual < flat_from)
      return foot_about(flat_m, -heel_behind_m, gait.swing() * strike_rad * (1.0 - usual / flat_from));
    const double heel = std::max(0.0, (usual - flat_until) / (toe_leaves - flat_until));
    return foot_about(flat_m, toe_ahead_m, gait.swing() * leave_rad * heel * heel);
  };
  const double leaves = toe_leaves * gait.stance();
  if (cycle < leaves) return standing(cycle);
  // In the air: cubics in the share of the swing that begin and end with the places and, along the way, the speeds of
  // stance; the heel comes down quickly, lest it brush the ground.
  const FootPose from = standing(leaves), to = standing(0.0);
  const double u = (cycle - leaves) / (1.0 - leaves), v = 1.0 - u;
  const double back_m = -gait.stride_m * (1.0 - leaves);
  // A runner's foot goes a longer way in the air, and rises more on it.
  constexpr double usual_m = (1.0 - toe_leaves) * longest_stance_stride_m;
  const double rises = gait.swing() * std::max(1.0, -back_m / usual_m), lift_m = 0.42 * rises, sinks_m = 0.06 * rises;
  const double landed = u * u * (3.0 - 2.0 * u);
  const auto between = [&](double a, double b) { return a + (b - a) * landed; };
  return {between(from.ahead_m, to.ahead_m) - u * u * v * back_m,
          to.above_m + v * v * (from.above_m - to.above_m + lift_m * u) + sinks_m * u * v,
          between(from.pitch_rad, to.pitch_rad) + 0.8 * gait.swing() * u * v * v,
          between(from.flat_ahead_m, to.flat_ahead_m)};
}

/// Height of the hips: of a walk highest above the foot that stands and lowest between two steps, of a run, lower in
/// all, the other way round.
inline double walking_hip_m(double phase_rad, const Gait& gait) {
  const double size2 = gait.size() * gait.size(), walks_m = 0.022 * size2;
  const double rises_m = walks_m * std::clamp((gait::toe_leaves * gait.stance() - 0.40) / 0.16, -1.0, 1.0);
  const double foot_below = 2.0 * std::numbers::pi * gait::strike_ahead_m * gait.size() / std::max(gait.stride_m, 1e-6);
  return hip_height_m - 0.034 * size2 - 1.5 * (walks_m - rises_m) + rises_m * std::cos(2.0 * (phase_rad - foot_below));
}

/// A place beside a curve, in the frame at the curve's beginning: x along it there.
struct CurvePlace {
  double x_m = 0.0, y_m = 0.0, turn_rad = 0.0;
};
/// `ahead_m` along a curve and `left_m` beside it.
inline CurvePlace beside_curve(double curvature_1pm, double ahead_m, double left_m) {
  const double turn = curvature_1pm * ahead_m;
  const bool straight = std::abs(turn) < 1e-6;
  const double along_m = straight ? ahead_m : std::sin(turn) / curvature_1pm,
               aside_m = straight ? 0.5 * turn * ahead_m : (1.0 - std::cos(turn)) / curvature_1pm;
  return {along_m - left_m * std::sin(turn), aside_m + left_m * std::cos(turn), turn};
}

/// Curvature of the way of somebody who goes on and turns. A sharper turn than about a metre's radius is a corner of the
/// way, on which the feet turn as well.
inline double walked_curvature_1pm(double speed_mps, double yaw_rate_radps) {
  if (!(speed_mps > 0.1)) return 0.0;
  const double curvature = yaw_rate_radps / speed_mps;
  return curvature * std::clamp(2.0 - std::abs(curvature), 0.0, 1.0);
}

/// A leg of a person who walks, with the foot's own angles.
struct WalkingLeg {
  LegAngles angles;
  double aside_rad = 0.0;  ///< Of the leg's plane about the forward axis, to the right above and to the left below.
  double foot_pitch_rad = 0.0, foot_turn_rad = 0.0;
};
/// `hip_ahead_m`, `hip_left_m`: place of the hip in the frame of the person, whose origin goes along the curve.
inline WalkingLeg walking_leg(double phase_rad, const Gait& gait, double curvature_1pm, double hip_ahead_m,
                              double hip_left_m) {
  const FootPose foot = walking_foot(phase_rad, gait);
  const CurvePlace flat = beside_curve(curvature_1pm, hip_ahead_m + foot.flat_ahead_m, hip_left_m);
  const double beyond_m = foot.ahead_m - foot.flat_ahead_m;
  const double ahead_m = flat.x_m + beyond_m * std::cos(flat.turn_rad) - hip_ahead_m,
               left_m = flat.y_m + beyond_m * std::sin(flat.turn_rad) - hip_left_m;
  const double below_m = walking_hip_m(phase_rad, gait) - foot.above_m;
  return {leg_to(ahead_m, std::hypot(below_m, left_m)), std::atan2(left_m, below_m), foot.pitch_rad, flat.turn_rad};
}
/// The arm goes against the leg of its side.
inline double walking_arm_rad(double phase_rad, const Gait& gait) { return -0.38 * gait.swing() * std::cos(phase_rad); }

/// Angles from the hip to the pedal. 0: the pedal is on top; it turns forward.
inline LegAngles pedalling_leg(double crank_rad) {
  return leg_to(bracket_ahead_m + crank_m * std::sin(crank_rad), bracket_below_m - crank_m * std::cos(crank_rad));
}

/// Joints of a person who was thrown: they travel where a vehicle's wheel lifts do (Participant::wheel_lift_m), for a
/// person has none. 0: stretched. In rad: thighs left and right, knees left and right.
using ThrownJoints = std::array<double, 4>;

}  // namespace septet
