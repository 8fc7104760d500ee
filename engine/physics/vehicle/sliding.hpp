#pragma once
/// A vehicle in plan that slides on four locked wheels: Coulomb friction against each wheel's own motion.
///
/// After a crash drivers brake, and bent bodies hold wheels fast: reconstructions take all wheels as locked, with equal
/// friction in all directions. World frame, on a level road: no gravity along a slope, and loads that do not shift.

#include <array>

#include "engine/physics/impact/body.hpp"
#include "engine/physics/vehicle/ground.hpp"

namespace septet::vehicle {

/// A locked tyre's friction by the surface's peak friction: 0.70 on dry asphalt of 0.9 (the middle of 0.70 to 0.90
/// minus the tyre's peak, as tables of reconstruction give it for skidding).
inline constexpr double locked_share = 0.78;

struct LockedWheel {
  Vec2 arm_m{0.0};           ///< From the mass centre, in the vehicle's axes: ahead, to the left.
  double load_share = 0.25;  ///< Of the vehicle's weight.
  double friction = 0.7;     ///< Of the sliding tyre.
};
using LockedWheels = std::array<LockedWheel, wheel_count>;

/// Steps to a tick: friction is stiff where a body turns slowly.
inline constexpr int sliding_steps = 8;

/// Moves the body through `dt_s`, about a tick: it slides, turns and comes to rest, velocities exactly 0.
void advance_sliding(const LockedWheels& wheels, double dt_s, impact::Body& body);

/// One step of these, of the same `dt_s` by sliding_steps; and what ends them.
void slide(const LockedWheels& wheels, double dt_s, impact::Body& body);
void come_to_rest(impact::Body& body);

}  // namespace septet::vehicle
