#pragma once
/// Parts in their mounts: those of a vehicle or a barrier that a crash can tear off.

#include <vector>

#include "engine/effects/debris/breakable_part.hpp"
#include "engine/math/rigid_transform.hpp"

namespace septet::debris {

struct MountedPart {
  Part part = Part::bumper;
  /// Place in the body's box: origin at the box's centre, x forward, y left, z up.
  RigidTransform box_from_part;
  double mount_strength_n = 0.0;  ///< Force of inertia at which the mounts give way.
};

/// Bumpers, head and tail lamps, four doors (two where the car is short) and the windscreen of a passenger car with a
/// box of these half sizes. Strength of their mounts: mounts.toml.
std::vector<MountedPart> passenger_car_parts(const Vec3& half_size_m);

}  // namespace septet::debris
