#pragma once
/// Textures of the world, painted procedurally. All tile in both directions unless said otherwise; sRGB.

#include <cstdint>

#include "engine/image/image.hpp"

namespace septet::scenery {

/// One lane across and 7.5 m along: aggregate, tyre polish in the wheel tracks, an oil-darkened middle, the seam of the
/// paver at the edge.
image::Image asphalt_texture(std::uint64_t seed);

/// Asphalt without tracks, 3.75 m a side: for crossing lanes.
image::Image plain_asphalt_texture(std::uint64_t seed);

/// Concrete slabs of half a metre with their joints, 1.5 m a side.
image::Image paving_texture(std::uint64_t seed);

/// Soil or grass in nearly neutral grey-green, about 6 m a side: multiplied by a field's colour.
image::Image ground_texture(std::uint64_t seed);

/// Formwork joints, pores and rain streaks; 4 m a side.
image::Image concrete_texture(std::uint64_t seed);

/// Leaves with holes between them, for the hulls of crowns.
image::Image leaf_texture(std::uint64_t seed);

/// Conifer branches that end ragged at the lower edge (does not tile upwards).
image::Image needle_texture(std::uint64_t seed);

inline constexpr std::uint32_t tree_pictures = 4;
/// Whole trees side by side for far away: oak, birch, spruce, bush. Does not tile.
image::Image tree_picture_texture(std::uint64_t seed);

/// Edge of a wood from the side, tiling along.
image::Image wood_edge_texture(std::uint64_t seed);

/// Windows and doors of a house front on plaster; one storey, 4 m a side.
image::Image facade_texture(std::uint64_t seed);

}  // namespace septet::scenery
