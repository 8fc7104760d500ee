#pragma once
/// Parts in their mounts: what a vehicle or a barrier carries that a crash can tear off.

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

/// Bumpers, head and tail lamps, four doors (two where the car is short) and the windscreen of a
/// passenger car whose box has these half sizes.
///
/// Strength of the mounts: doors by UN Regulation 11 and FMVSS 206 (latch and hinges hold 11 kN
/// along the car); the bonded windscreen by its bead; bumper skins and lamps hold by clips and
/// screws, for which no figure is published. Chosen: 30 times the part's weight. A bumper's test at 4 km/h (UN Regulation 42)
/// gives it 3 g by the crush of crash.hpp and a jolt while parking at 15 km/h 10 g, which clips survive; a barrier at 70 km/h
/// gives 47 g, after which bumpers lie on the road. Between, 30 g is reached at 45 km/h against a wall.
std::vector<MountedPart> passenger_car_parts(const Vec3& half_size_m);

}  // namespace septet::debris
