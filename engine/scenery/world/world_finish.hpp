#pragma once
/// Finishes of the world: road, land, plants and buildings.

#include <cstdint>

#include "engine/scenery/palette.hpp"

namespace septet::scenery {

enum class Ground : std::uint32_t {
  asphalt,
  asphalt_fresh,
  asphalt_old,
  asphalt_tunnel,
  asphalt_plain,  ///< Asphalt of junctions, where lanes cross: the same in every direction.
  cycle_path,
  paving,
  kerb_stone,
  repair,
  repair_edge,
  crack,
  mark,
  mark_tunnel,
  paint,  ///< Paint as of marks, for shapes that are no stripes.
  concrete,
  concrete_dark,
  concrete_tunnel,
  tiles_tunnel,
  lamp_tunnel,
  exit_sign,
  metal,
  metal_dark,
  lamp_red,
  lamp_amber,
  lamp_green,
  lamp_street,
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
  water_shaded,
  facade_red,  ///< Walls along a street, to facade_grey.
  facade_white,
  facade_yellow,
  facade_grey,
  plaster_white,  ///< Walls of a town, to sandstone.
  plaster_ochre,
  plaster_rose,
  plaster_green,
  plaster_blue,
  brick_red,
  brick_brown,
  sandstone,
  shop_bakery,  ///< Fronts of shops, to shop_flowers.
  shop_chemist,
  shop_cafe,
  shop_flowers,
  door,
  awning_red,
  awning_green,
  farm_red,  ///< Walls among fields, as are those of farm_white.
  farm_white,
  roof_tiles,
  roof_dark,
  planks,
  window_lit,  ///< Pane before a lit room: as dark as others by day.
  far_asphalt,
  palette,
  // Colours of the palette, which are no materials of their own: see to_palette.
  far_mark,
  far_mark_broken,
  far_concrete,
  far_verge,
  far_meadow,
  far_pasture,
  far_wheat,
  far_rape,
  far_soil,
  far_crop,
  far_wood,
  far_canopy,
};

constexpr std::uint32_t index_of(Ground ground) { return static_cast<std::uint32_t>(ground); }

/// Colour of a ground for far away; `ground` itself where it has no such colour.
Ground far_of(Ground ground);

/// Gives all polygons of a palette's colour the one material `palette` and the texture coordinates
/// of their colour in its bitmap, so that a mesh of many colours costs one draw.
void to_palette(geometry::PolygonMesh& mesh);

/// Adds one material for each, in their order, with their bitmaps; those of junctions and towns only if the world has
/// some.
Palette add_world_finishes(scene::SceneBuilder& builder, std::uint64_t seed, bool towns);

}  // namespace septet::scenery
