#pragma once
/// Parts in their mounts: those of a vehicle or a barrier that a crash can tear off.

#include <cstdint>
#include <vector>

#include "engine/effects/debris/breakable_part.hpp"
#include "engine/math/rigid_transform.hpp"
#include "engine/world/snapshot.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::debris {

/// Places of a passenger car's parts.
enum class Mount : std::uint8_t {
  front_bumper,
  front_left_lamp,
  front_right_lamp,
  rear_bumper,
  rear_left_lamp,
  rear_right_lamp,
  front_left_door,
  front_right_door,
  rear_left_door,
  rear_right_door,
  windscreen,
  front_left_window,
  front_right_window,
  rear_left_window,
  rear_right_window,
};
inline constexpr int mount_count = 15;

/// A set of mounts, one bit each.
using Mounts = std::uint16_t;
inline constexpr Mounts bit_of(Mount mount) { return static_cast<Mounts>(1u << static_cast<unsigned>(mount)); }

/// The door that carries a window's mount; of any other mount itself.
Mount carrier_of(Mount mount);

/// What a piece was part of before it was torn off: how it looks, not how it moves.
struct PieceOrigin {
  ParticipantId vehicle = 0;
  ModelIndex model = 0;
  std::uint8_t paint = 0;  ///< As Participant::paint.
  Mount mount = Mount::front_bumper;
  bool operator==(const PieceOrigin&) const = default;
};

struct MountedPart {
  Part part = Part::bumper;
  /// Place in the body's box: origin at the box's centre, x forward, y left, z up.
  RigidTransform box_from_part;
  double mount_strength_n = 0.0;  ///< Force of inertia at which the mounts give way.
  Mount mount = Mount::front_bumper;
};

/// Bumpers, head and tail lamps, four doors (two where the car is short), each before its window, and the windscreen of a
/// passenger car with a box of these half sizes. Strength of their mounts: mounts.toml.
std::vector<MountedPart> passenger_car_parts(const Vec3& half_size_m);

}  // namespace septet::debris
