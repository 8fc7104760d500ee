#pragma once
/// The finishes of the world: road, land, plants and buildings.

#include <cstdint>

#include "engine/scenery/palette.hpp"

namespace septet::scenery {

enum class Ground : std::uint32_t {
  asphalt,
  asphalt_fresh,
  asphalt_old,
  asphalt_tunnel,
  repair,
  mark,
  mark_far,
  mark_tunnel,
  concrete,
  concrete_dark,
  concrete_tunnel,
  tiles_tunnel,
  lamp_tunnel,
  exit_sign,
  metal,
  metal_dark,
  reflector,
  post,
  verge,
  gravel,
  meadow,
  pasture,
  wheat,
  rape,
  soil,
  crop,
  wood_floor,
  canopy,
  wood_edge,
  leaves_oak,
  leaves_birch,
  needles,
  crown_core,
  bark,
  bark_birch,
  tree_pictures,
  noise_wall,
  water,
  facade_red,
  facade_white,
  roof_tiles,
  roof_dark,
  planks,
};

constexpr std::uint32_t index_of(Ground ground) { return static_cast<std::uint32_t>(ground); }

/// One material for each, in their order, with their bitmaps.
Palette add_world_finishes(scene::SceneBuilder& builder, std::uint64_t seed);

}  // namespace septet::scenery
