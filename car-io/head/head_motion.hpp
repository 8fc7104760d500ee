#pragma once
/// Where the driver's head is, from a tracker's datagrams.
///
/// OpenTrack's "UDP over network" output: six doubles, little-endian, x, y, z in centimetres and yaw, pitch, roll in degrees, 48 bytes, as
/// often as the tracker's camera sees. Which of them is which way differs from tracker to tracker, so that the rig says it. Whoever can reach
/// the port can send anything: what is no such datagram, or not finite, is as if it had not come; what is too far is held at the rig's reach,
/// and no head moves faster than `fastest_mps`. A tracker that falls silent leaves the head gliding back to rest.
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

/// Nothing: the bytes are no finite pose.
std::optional<TrackedPose> read_tracked_pose(std::span<const std::byte> datagram);

/// Where the eyes are beside the eye point, metres, and where the head points.
struct HeadPlace {
  Vec3 from_rest_m{0.0};
  double heading_rad = 0.0;  ///< Positive to the left, within ±π.
};

/// In the car's axes, within the rig's reach.
HeadPlace place_of(const TrackedPose& pose, const rig::HeadTracking& tracking);

struct HeadMotion {
  HeadPlace place;   ///< Now.
  Vec3 told_m{0.0};  ///< Place that the tracker said last, from rest.
  /// Heading that it said last, counted on past a half turn as the head went, so that it comes back the way that it went; within ±`furthest_rad`.
  double told_rad = 0.0;
  std::optional<double> silence_s;  ///< Since then; nothing: it has said nothing yet.
  double share = 0.0;               ///< Of what was told; 0: at rest, 1: followed.
};

inline constexpr double tracker_is_lost_after_s = 0.5;
inline constexpr double glide_s = 1.0;  ///< From what was told to rest, and back.
inline constexpr double fastest_mps = 3.0, fastest_radps = 15.0;
/// Body and neck turn no further than this; beyond it the tracker means the other way round.
inline constexpr double furthest_rad = 1.5 * std::numbers::pi;

bool is_tracked(const HeadMotion& motion);
/// `dt_s` later; `heard`: the newest that has come meanwhile.
void advance(HeadMotion& motion, const std::optional<HeadPlace>& heard, double dt_s);

}  // namespace septet::car_io
