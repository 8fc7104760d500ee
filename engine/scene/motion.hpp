#pragma once
/// Motion of an object by itself: a few legs, each evenly accelerated and evenly turning, so that every screen, film and
/// ray tracer knows the pose of any instant, between ticks too, from one command.
///
/// Source: Brink, Steenberg and Svensson 2006, §2.4.1: derivatives of a transform with the time from which they hold,
/// queued ahead. Units: metres, seconds of simulated time, radians; the frame is the world's.

#include <cstddef>
#include <vector>

#include "engine/math/rigid_transform.hpp"

namespace septet::scene {

struct MotionLeg {
  double from_s = 0.0;     ///< Until the next leg begins; the last one goes on.
  Vec3 velocity_mps{0.0};  ///< At its beginning.
  Vec3 acceleration_mps2{0.0};
  Vec3 turn_radps{0.0};  ///< Axis times rate.
  bool operator==(const MotionLeg&) const = default;
};
inline constexpr std::size_t max_motion_legs = 16;
/// Bound of a leg's speed in m/s, acceleration in m/s² and turn in rad/s.
inline constexpr double max_motion_rate = 1e4;

/// Each leg begins where the one before it ends. No legs: no motion.
struct Motion {
  Vec3 position_m{0.0};               ///< Until the first leg begins.
  Quat rotation{1.0, 0.0, 0.0, 0.0};  ///< Likewise.
  std::vector<MotionLeg> legs;        ///< `from_s` rises.
  bool operator==(const Motion&) const = default;
};

struct MovingPose {
  RigidTransform world_from_object;
  Vec3 velocity_mps{0.0};
  Vec3 turn_radps{0.0};  ///< Axis times rate.
};

MovingPose pose_at(const Motion& motion, double simulated_time_s);

}  // namespace septet::scene
