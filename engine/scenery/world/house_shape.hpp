#pragma once
/// House: walls with windows, a saddle roof with eaves, its chimney.

#include "engine/core/random.hpp"
#include "engine/geometry/mesh_builder.hpp"
#include "engine/roadside/buildings.hpp"
#include "engine/scenery/world/world_finish.hpp"

namespace septet::scenery {

struct HouseLook {
  float eaves, ridge;  ///< Heights over the ground.
  Ground wall, roof;
  float over_gable_m = 0.5f;  ///< Overhang of the roof; hardly any where the next house adjoins.
};

/// Adds a house at the block's place; the walls reach 1.5 m into the ground.
void add_house(geometry::MeshBuilder& builder, const roadside::HouseBlock& block, const HouseLook& look);

/// Adds panes of Ground::window_lit before that share of the windows of the same house, drawn by `random`.
void add_lit_windows(geometry::MeshBuilder& builder, const roadside::HouseBlock& block, const HouseLook& look,
                     double share, Random& random);

}  // namespace septet::scenery
