#pragma once
/// Limbs that hang from joints, and sitting people: parts of pedestrians, riders and occupants. Metres.

#include <cstdint>
#include <span>

#include "engine/scenery/vehicles/vehicle_parts.hpp"

namespace septet::scenery {

/// Thigh, shin and shoe, hanging from the origin: hip, knee and ankle. `sides` sets the level of detail.
geometry::PolygonMesh hanging_thigh(std::uint32_t sides);
geometry::PolygonMesh hanging_shin(std::uint32_t sides);
geometry::PolygonMesh shoe(std::uint32_t sides);

/// Adds both legs as parts that move by their roles, from the hips' middle. Those who walk have feet that turn in the
/// ankle; a cyclist's hang from the shins.
void add_walking_legs(VehicleParts& parts, const glm::vec3& hips_m, std::uint32_t sides);
void add_pedalling_legs(VehicleParts& parts, const glm::vec3& hips_m, std::uint32_t sides);

/// Person from the hips up, belted in; the head's middle is at the origin, and faces ahead. `splits` as for
/// geometry::icosphere, of the head.
geometry::PolygonMesh sitting_person(std::uint32_t splits);

/// Seat behind a person whose head is at the origin.
geometry::PolygonMesh seat_back();

/// Seat behind a window of a large vehicle, by the position of the head.
struct SeatPlace {
  glm::vec3 head_m;
  bool taken = true;
};
/// Seats and the people on taken ones as two meshes, so that a full coach is a few draws.
VehicleParts seated_people(std::span<const SeatPlace> places);

}  // namespace septet::scenery
