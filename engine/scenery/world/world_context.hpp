#pragma once
/// Input of every part of the world's construction.

#include <cstdint>

#include "engine/roadside/plants.hpp"
#include "engine/roadside/raised_areas.hpp"
#include "engine/roadside/road_shape.hpp"
#include "engine/roadside/terrain.hpp"
#include "engine/scenery/own_models.hpp"
#include "engine/scenery/palette.hpp"

namespace septet::scenery {

using roadside::Nearest;
using roadside::RoadShape;
using roadside::RoadTile;
using roadside::squares_near;
using roadside::stations;
using roadside::Terrain;

struct WorldContext {
  scene::SceneBuilder& builder;
  const RoadShape& roads;
  const Terrain& terrain;
  const roadside::RaisedAreas& raised;
  const Palette& palette;  ///< Materials by Ground.
  OwnShapes& own;          ///< User's own models.
  std::uint64_t seed;
};

/// Adds a mesh in a tile's frame, drawn within a range, on a grid of 1 mm so that layers keep apart.
inline void add_tile_mesh(const WorldContext& world, const RoadTile& tile, std::string_view name,
                          const geometry::PolygonMesh& mesh, float from_m, float to_m, bool casts_shadow = false) {
  if (mesh.polygons.empty()) return;
  scene::MeshOptions options;
  options.position_step_m = 1.0 / 1024.0;
  Placement placement;
  placement.parent_from_object = tile.world_from_tile;
  placement.visible_from_m = from_m;
  placement.visible_to_m = to_m;
  placement.casts_shadow = casts_shadow;
  place(world.builder, name, add_shape(world.builder, name, mesh, world.palette, options), placement);
}

/// Distances up to which the road's precise tiles, near land, and anything at all are drawn, from their middle.
inline constexpr float road_near_m = 380.0f, land_near_m = 800.0f, all_m = 14000.0f;
/// Reach of the land beyond the roads, and the side of its squares.
inline constexpr double land_reach_m = 5200.0, land_tile_m = roadside::far_land_tile_m;

void build_pavement(const WorldContext& world);  ///< Asphalt, repairs, markings.
void build_far_road(const WorldContext& world);  ///< All parts of the road, simplified.
void build_verges(const WorldContext& world);    ///< Ground from the asphalt's edge into the land.
void build_land(const WorldContext& world);      ///< Fields, woods, far hills, water.
void build_barriers(const WorldContext& world);  ///< Guard rails, median barrier, parapets, noise walls, posts.
void build_kerbs(const WorldContext& world);     ///< Kerbs, islands, pavements round corners.
void build_bridges(const WorldContext& world);
void build_tunnels(const WorldContext& world);
void build_gantries(const WorldContext& world);    ///< Gantries with signs and speed displays.
void build_streets(const WorldContext& world);     ///< Houses and lamps of towns.
void build_furniture(const WorldContext& world);   ///< Benches, bins, lids and other small things of streets.
void build_objects(const WorldContext& world);     ///< Objects that the road file places beside the road.
void build_signals(const WorldContext& world);     ///< Boards on posts, traffic lights.
void build_road_paint(const WorldContext& world);  ///< Crossings, stop lines, arrows.
void build_trees(const WorldContext& world);
void build_buildings(const WorldContext& world);

}  // namespace septet::scenery
