#pragma once
/// Limbs that hang from joints, and people who sit: what walkers, riders and occupants are put together from. Metres.

#include <cstdint>
#include <span>

#include "engine/scenery/vehicles/vehicle_parts.hpp"

namespace septet::scenery {

/// A thigh, or a shin with its shoe, hanging from the origin. `sides` sets the level of detail.
geometry::PolygonMesh hanging_thigh(std::uint32_t sides);
geometry::PolygonMesh hanging_shin(std::uint32_t sides);

/// Both legs as four parts that move by their roles, from the hips' middle; `first` is the left leg's role, and those of the right leg and the
/// shins follow it (PartRole).
void add_legs(VehicleParts& parts, scene::PartRole first, const glm::vec3& hips_m, std::uint32_t sides);

/// From the hips up, belted in; the head's middle is in the origin, and looks ahead. `splits` as for geometry::icosphere, of the head.
geometry::PolygonMesh sitting_person(std::uint32_t splits);

/// The seat behind who sits with his head in the origin.
geometry::PolygonMesh seat_back();

/// One who sits behind a window of a large vehicle: a place for the head.
struct SeatPlace {
  glm::vec3 head_m;
  bool taken = true;
};
/// Seats and whoever takes them as two meshes, so that a full coach is a few draws.
VehicleParts seated_people(std::span<const SeatPlace> places);

}  // namespace septet::scenery
