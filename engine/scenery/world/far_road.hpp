#pragma once
/// Road as seen from afar: pavement, lines, verges and barriers of a tile in one mesh of a few plain materials, so that
/// it costs few draws. Each part is drawn by the file that draws its near form.

#include "engine/geometry/mesh_builder.hpp"
#include "engine/scenery/world/world_context.hpp"

namespace septet::scenery {

/// `step_m` is the distance between stations.
void draw_far_marks(geometry::MeshBuilder& builder, const WorldContext& world, const RoadTile& tile, double step_m);
void draw_far_verges(geometry::MeshBuilder& builder, const WorldContext& world, const RoadTile& tile, double step_m);
void draw_far_barriers(geometry::MeshBuilder& builder, const WorldContext& world, const RoadTile& tile, double step_m);

}  // namespace septet::scenery
