#pragma once
/// Trees, bushes and woods, for the scenery that draws them and the cars that run against them.
///
/// Single trees are a list. A wood is drawn as one canopy over the cells of the land's grid; its stems stand at the
/// points of a jittered lattice within those cells, and are computed near a query only.

#include <cstdint>
#include <vector>

#include "engine/roadside/terrain.hpp"

namespace septet::roadside {

enum class TreeKind : std::uint8_t { oak, birch, spruce, bush };
inline constexpr int tree_kind_count = 4, tree_variant_count = 2;

struct Tree {
  TreeKind kind = TreeKind::oak;
  Vec3 foot_m{0.0};
  double turn_rad = 0.0;
  double size = 1.0;  ///< Scale of its drawing, the trunk included.
  int variant = 0;
};

/// Radius at a car's height of a tree of size 1; for a bush, of the part that holds a car.
double trunk_radius_m(TreeKind kind);

/// Single trees and groups on meadows, bushes along the verges, the fringe of woods. Houses are kept free.
std::vector<Tree> planted_trees(const RoadShape& roads, const Terrain& terrain, std::uint64_t seed);

/// Sides of the land's tiles and of the cells in them, coarser further from the roads.
inline constexpr double land_tile_m = 512.0, middle_land_tile_m = 1024.0, far_land_tile_m = 2048.0;
inline constexpr double land_cell_m = land_tile_m / 24, middle_land_cell_m = land_tile_m / 6,
                        far_land_cell_m = far_land_tile_m / 16;
/// Distances from every road beyond which a tile, by its middle, has the coarser cells.
inline constexpr double land_within_m = 640.0, middle_land_within_m = 1150.0, far_land_from_m = 2900.0;

/// True if the cell of this size with this middle bears a wood.
bool is_wood(const Terrain& terrain, const Vec2& middle_m, double cell_m);

struct Stem {
  Vec2 middle_m;
  double radius_m;
  std::uint32_t number;  ///< Stable number of the stem.
};
/// Stems of woods within `reach_m`.
std::vector<Stem> wood_stems(const Terrain& terrain, std::uint64_t seed, const Vec2& p, double reach_m);

}  // namespace septet::roadside
