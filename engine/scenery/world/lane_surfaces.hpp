#pragma once
/// Surfaces of the lanes of a road, at the height of the wheels' surface, with kerbs between lanes of different
/// heights, and their materials.

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/polygon_mesh.hpp"
#include "engine/road/lane.hpp"
#include "engine/scenery/world/world_context.hpp"
#include "engine/scenery/world/world_finish.hpp"

namespace septet::scenery {

/// Material of a lane at a tile. In a junction lanes of several roads overlap, all in one asphalt.
Ground ground_of(const WorldContext& world, const RoadTile& tile, const road::Lane& lane);

/// Lanes of a tile, each at its height (OpenDRIVE 1.8, §11.7.3), a face wherever two of them differ.
geometry::PolygonMesh lane_surfaces(const WorldContext& world, const RoadTile& tile);

/// Draws the lanes for a far view: one strip for neighbouring lanes of one colour.
void draw_far_pavement(geometry::MeshBuilder& builder, const WorldContext& world, const RoadTile& tile, double step_m);

}  // namespace septet::scenery
