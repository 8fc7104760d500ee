#pragma once
/// Measurements on shown vehicles: overlapping outlines, and motion impossible for a car.

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "engine/world/snapshot.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::traffic {

using Outline = std::array<Vec2, 4>;

inline Outline outline(const Participant& participant) {
  const VehicleModel& model = vehicle_models()[participant.model];
  Outline corners;
  std::size_t k = 0;
  for (const double x : {-model.rear_overhang_m, model.front_m()})
    for (const double y : {-0.5, 0.5})
      corners[k++] = Vec2(participant.world_from_vehicle * Vec3(x, y * model.width_m, 0.0));
  return corners;
}

/// True if two vehicles' oriented outlines overlap: by the separating axes of their boxes.
inline bool overlap(const Outline& a, const Outline& b) {
  for (const Outline& corners : {a, b}) {
    for (const Vec2 axis : {corners[2] - corners[0], corners[1] - corners[0]}) {
      double a_low = 1e300, a_high = -1e300, b_low = 1e300, b_high = -1e300;
      for (const Vec2& c : a) a_low = std::min(a_low, glm::dot(c, axis)), a_high = std::max(a_high, glm::dot(c, axis));
      for (const Vec2& c : b) b_low = std::min(b_low, glm::dot(c, axis)), b_high = std::max(b_high, glm::dot(c, axis));
      if (a_high < b_low || b_high < a_low) return false;
    }
  }
  return true;
}

/// Pairs of participants whose outlines overlap.
inline int overlapping_pairs(std::vector<Participant> participants) {
  constexpr double near_m = 14.0;  // Two lorries' middles, one behind the other.
  const auto x = [](const Participant& p) { return p.world_from_vehicle.position_m.x; };
  const auto y = [](const Participant& p) { return p.world_from_vehicle.position_m.y; };
  std::ranges::sort(participants, {}, x);
  std::vector<Outline> outlines;
  for (const Participant& participant : participants) outlines.push_back(outline(participant));
  int count = 0;
  for (std::size_t i = 0; i < participants.size(); ++i)
    for (std::size_t k = i + 1; k < participants.size(); ++k) {
      if (x(participants[k]) - x(participants[i]) > near_m) break;
      if (std::abs(y(participants[k]) - y(participants[i])) > near_m) continue;
      count += overlap(outlines[i], outlines[k]);
    }
  return count;
}

/// The worst motion from tick to tick. A vehicle that moves farther than possible in a tick has entered again at the
/// other rim.
struct MotionCheck {
  static constexpr double least_radius_m = 8.0;
  static constexpr double longest_step_m = 5.0;

  double most_sideways_m = 0.0;      ///< Across the direction in which the vehicle points.
  double most_overturned_rad = 0.0;  ///< Turned farther than on an arc of the least radius.

  void observe(const std::vector<Participant>& participants) {
    for (const Participant& now : participants) {
      const auto [at, is_new] = before_.try_emplace(now.id, now.world_from_vehicle);
      const RigidTransform before = at->second;
      at->second = now.world_from_vehicle;
      const Vec3 moved = now.world_from_vehicle.position_m - before.position_m;
      if (is_new || glm::length(moved) > longest_step_m) continue;
      const Vec3 ahead = now.world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0);
      const Vec3 ahead_before = before.orientation * Vec3(1.0, 0.0, 0.0);
      const Vec3 middle = glm::normalize(ahead + ahead_before);
      const double sideways = std::abs(middle.x * moved.y - middle.y * moved.x);
      const double turned = std::abs(std::asin(ahead_before.x * ahead.y - ahead_before.y * ahead.x));
      const double overturned = turned - glm::length(moved) / least_radius_m;
      most_sideways_m = std::max(most_sideways_m, sideways);
      most_overturned_rad = std::max(most_overturned_rad, overturned);
    }
  }

 private:
  std::unordered_map<ParticipantId, RigidTransform> before_;
};

}  // namespace septet::traffic
