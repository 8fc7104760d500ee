#pragma once
/// Lamps as flat plates: all vehicles share one mesh for each finish and side, so that the lamps of a whole road are
/// drawn together.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"

namespace septet::scenery {

/// Lamp that faces ahead or back. `size_m`: across and upright.
VehiclePart lens_plate(const char* name, scene::PartRole role, Finish finish, bool ahead, const glm::vec3& middle_m,
                       const glm::vec2& size_m);

/// Positions of the lamps of a vehicle with flat ends: y and z of their middles on the left; those on the right are
/// mirror images.
struct LampPlaces {
  float nose_x = 0.0f, tail_x = 0.0f;
  glm::vec2 head{0.94f, 0.86f}, tail{0.86f, 0.93f}, brake{1.01f, 0.93f}, reverse{0.72f, 0.93f}, indicator{1.15f, 0.93f};
  glm::vec2 size_m{0.14f, 0.14f}, head_size_m{0.32f, 0.17f};
  bool has_nose = true;  ///< False for trailers, which have no lamps that face ahead.
};
void add_lamp_plates(VehicleParts& parts, const LampPlaces& places, DetailLevel level);

/// Blue lamp; those to the left and to the right of the middle flash in turn.
VehiclePart beacon_box(const glm::vec3& middle_m, const glm::vec3& size_m);

}  // namespace septet::scenery
