#pragma once
/// Clothes as rings of an upright tube, with folds: jackets, sleeves, trouser legs. Metres.

#include <cstdint>
#include <span>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/scenery/vehicles/finish.hpp"

namespace septet::scenery {

/// One cross-section, an ellipse on the level.
struct GarmentRing {
  glm::vec3 centre_m;
  float half_depth_m, half_width_m;  ///< Along x and y.
  float fold_m = 0.0f;               ///< Depth of its folds.
};

/// Adds a closed tube over the rings, from the lowest to the highest, with the builder's material. `folds`: number of
/// folds around a ring; they wander from ring to ring.
void add_garment(geometry::MeshBuilder& builder, std::span<const GarmentRing> rings, std::uint32_t sides,
                 std::uint32_t folds);

}  // namespace septet::scenery
