#include "engine/scenery/world/far_road.hpp"

#include "engine/scenery/world/lane_surfaces.hpp"
#include "engine/scenery/world/world_finish.hpp"

namespace septet::scenery {
namespace {

/// Tile lengths. Long tiles take over at a distance. Their middles lie further apart than those of short ones, so both
/// are drawn over half a long tile to either side: a gap would show, an overlap does not at this distance.
constexpr double short_tile_m = 160.0, long_tile_m = 640.0;
constexpr float short_until_m = 1500.0f, long_from_m = 1100.0f;

void add_far(const WorldContext& world, const RoadTile& tile, double step_m, float from_m, float to_m) {
  geometry::MeshBuilder builder;
  draw_far_pavement(builder, world, tile, step_m);
  draw_far_marks(builder, world, tile, step_m);
  draw_far_verges(builder, world, tile, step_m);
  draw_far_barriers(builder, world, tile, step_m);
  geometry::PolygonMesh mesh = builder.take();
  for (auto& uvs : mesh.corner_uvs) uvs = {};
  to_palette(mesh);
  add_tile_mesh(world, tile, "road far", mesh, from_m, to_m);
}

}  // namespace

void build_far_road(const WorldContext& world) {
  for (const RoadTile& tile : world.roads.tiles(short_tile_m)) add_far(world, tile, 40.0, road_near_m, short_until_m);
  for (const RoadTile& tile : world.roads.tiles(long_tile_m)) add_far(world, tile, 80.0, long_from_m, 7000.0f);
}

}  // namespace septet::scenery
