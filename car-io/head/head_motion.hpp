#pragma once
/// Position of the driver's head, from a tracker's datagrams.
///
/// OpenTrack's "UDP over network" output: six doubles, little-endian, x, y, z in centimetres and yaw, pitch, roll in
/// degrees, 48 bytes, at the rate of the tracker's camera. The assignment of axes and signs differs from tracker to
/// tracker, so the rig gives it. Any host that reaches the port can send: other datagrams, and non-finite ones, are
/// ignored; positions are limited to the rig's reach, and no head moves faster than `fastest_mps`. After a tracker
/// falls silent the head glides back to rest.
///
/// Pure: the caller owns socket and clock.

#include <array>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>

#include "engine/rig/rig.hpp"
#include "engine/world/driver_input.hpp"

namespace septet::car_io {

/// x, y, z (cm), yaw, pitch, roll (degrees), as rig::HeadAxis::Of counts them.
using TrackedPose = std::array<double, 6>;

/// Empty: the bytes are not a finite pose.
std::optional<TrackedPose> read_tracked_pose(std::span<const std::byte> datagram);

/// Offset of the eyes from the eye point, metres, and the head's heading.
struct HeadPlace {
  Vec3 from_rest_m{0.0};
  double heading_rad = 0.0;  ///< Positive to the left, within ±π.
};

/// In the car's axes, within the rig's reach.
HeadPlace place_of(const TrackedPose& pose, const rig::HeadTracking& tracking);

struct HeadMotion {
  HeadPlace place;   ///< Now.
  Vec3 told_m{0.0};  ///< The tracker's last place, relative to rest.
  /// Its last heading, continued past a half turn, so that it returns along the same path; within ±`furthest_rad`.
  double told_rad = 0.0;
  std::optional<double> silence_s;  ///< Time since then; empty: no datagram yet.
  double share = 0.0;               ///< Weight of the tracker's pose; 0: at rest, 1: followed.
};

inline constexpr double tracker_is_lost_after_s = 0.5;
inline constexpr double glide_s = 1.0;  ///< From the tracker's pose to rest, and back.
inline constexpr double fastest_mps = 3.0, fastest_radps = 15.0;
/// Body and neck turn no further than this; beyond it the tracker means the opposite turn.
inline constexpr double furthest_rad = 1.5 * std::numbers::pi;

bool is_tracked(const HeadMotion& motion);
/// Advances by `dt_s`; `heard`: the newest pose received meanwhile.
void advance(HeadMotion& motion, const std::optional<HeadPlace>& heard, double dt_s);

}  // namespace septet::car_io
