#include "car-io/head/head_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "engine/core/bytes.hpp"

namespace septet::car_io {
namespace {

double told_by(const TrackedPose& pose, const rig::HeadAxis& axis) {
  const double value = pose[static_cast<std::size_t>(axis.of)];
  return axis.inverted ? -value : value;
}

constexpr double whole_turn_rad = 2.0 * std::numbers::pi;

/// A share that begins and ends at rest.
double eased(double share) { return share * share * (3.0 - 2.0 * share); }

}  // namespace

std::optional<TrackedPose> read_tracked_pose(std::span<const std::byte> datagram) {
  TrackedPose pose{};
  if (datagram.size() != pose.size() * sizeof(double)) return std::nullopt;
  ByteReader reader(datagram);
  for (double& value : pose) {
    value = reader.get_double();
    if (!std::isfinite(value)) return std::nullopt;
  }
  return pose;
}

HeadPlace place_of(const TrackedPose& pose, const rig::HeadTracking& tracking) {
  constexpr double cm = 0.01, degree = std::numbers::pi / 180.0;
  const Vec3 told_m(cm * told_by(pose, tracking.forward), cm * told_by(pose, tracking.left),
                    cm * told_by(pose, tracking.up));
  HeadPlace place{.from_rest_m = glm::clamp(told_m, -tracking.reach_m, tracking.reach_m)};
  place.heading_rad = std::remainder(degree * told_by(pose, tracking.turn_left), whole_turn_rad);
  return place;
}

bool is_tracked(const HeadMotion& motion) { return motion.silence_s && *motion.silence_s < tracker_is_lost_after_s; }

void advance(HeadMotion& motion, const std::optional<HeadPlace>& heard, double dt_s) {
  if (motion.silence_s) *motion.silence_s += dt_s;
  if (heard) {
    motion.told_m = heard->from_rest_m;
    if (motion.share == 0.0) motion.told_rad = 0.0;
    motion.told_rad += std::remainder(heard->heading_rad - motion.told_rad, whole_turn_rad);
    if (std::abs(motion.told_rad) > furthest_rad) motion.told_rad -= std::copysign(whole_turn_rad, motion.told_rad);
    motion.silence_s = 0.0;
  }
  motion.share = std::clamp(motion.share + (is_tracked(motion) ? dt_s : -dt_s) / glide_s, 0.0, 1.0);
  const double share = eased(motion.share);
  const Vec3 way_m = share * motion.told_m - motion.place.from_rest_m;
  const double length_m = glm::length(way_m), most_m = fastest_mps * dt_s;
  motion.place.from_rest_m += length_m > most_m ? way_m * (most_m / length_m) : way_m;
  const double turn_rad = std::remainder(share * motion.told_rad - motion.place.heading_rad, whole_turn_rad);
  const double turned_rad = std::clamp(turn_rad, -fastest_radps * dt_s, fastest_radps * dt_s);
  motion.place.heading_rad = std::remainder(motion.place.heading_rad + turned_rad, whole_turn_rad);
}

}  // namespace septet::car_io
