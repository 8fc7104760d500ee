#pragma once
/// Eyes of a participant: their place in the vehicle, the mirrors around them; and the extent of a target.

#include <optional>
#include <string>
#include <vector>

#include "engine/rig/rig.hpp"
#include "engine/sight/line_of_sight.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::sight {

/// A mirror's glass, vehicle frame. `normal` = right × up, towards the eyes.
struct Mirror {
  std::string name;
  Vec3 middle_m{0.0}, right{1, 0, 0}, up{0, 0, 1};
  double half_width_m = 0.0, half_height_m = 0.0;
  double radius_m = 0.0;  ///< Of a convex glass's curvature; 0: flat.

  Vec3 normal() const;
  /// Normal at a place of the glass, metres from its middle.
  Vec3 normal_at(double across_m, double upward_m) const;
};

/// Eyes of the driver of a session by its rig; of others by their model.
struct DriverSeat {
  Vec3 eye_m{0.0};  ///< At rest, vehicle frame.
  std::optional<rig::Rig> rig;
};

/// Eye point in the vehicle frame at this instant: the driver's by the logged head.
Vec3 eye_in_vehicle(const Participant& observer, const Snapshot& world, const DriverSeat& seat);

/// Mirrors around the eyes: of the driver's car those of the rig, of others those of the model.
std::vector<Mirror> mirrors_of(const Participant& observer, const Snapshot& world, const DriverSeat& seat);

/// Box around a participant, mirrors and limbs included.
Box box_around(const Participant& participant);

}  // namespace septet::sight
