#pragma once
/// Limbs that hang from joints, and people who sit: what walkers, riders and occupants are put together from. Metres.

#include "engine/scenery/vehicles/vehicle_parts.hpp"

namespace septet::scenery {

/// A thigh, or a shin with its shoe, hanging from the origin. `sides` sets the level of detail.
geometry::PolygonMesh hanging_thigh(std::uint32_t sides);
geometry::PolygonMesh hanging_shin(std::uint32_t sides);

/// Both legs as four parts that move by their roles, from the hips' middle; `first` is the left leg's role, and those of the right leg and the
/// shins follow it (PartRole).
void add_legs(VehicleParts& parts, scene::PartRole first, const glm::vec3& hips_m, std::uint32_t sides);

}  // namespace septet::scenery
