#pragma once
/// Images of a material beside that of its base colour: one table instead of a member for each.
///
/// Each lies by the texture coordinates of the base colour's image, or by a second set that all others share.

#include <array>
#include <cstddef>
#include <cstdint>

namespace septet::scene {

enum class SurfaceMap : std::uint8_t {
  emission,    ///< Colour that multiplies the emission; the base colour's image does not.
  properties,  ///< Linear. Red: share of the light from around that arrives. Green, blue: roughness and metallic, times
               ///< the material's own.
  normal,      ///< Linear. Red, green, blue from −1 to 1: along u, up in the picture (against v), out of the surface.
};
inline constexpr std::size_t surface_map_count = 3;

/// Tags of a material's group "surface" that hold the bitmaps, by SurfaceMap (CONVENTIONS.md, "Materials").
inline constexpr std::array<const char*, surface_map_count> surface_map_tags{"emission_bitmap", "properties_bitmap",
                                                                             "normal_bitmap"};

/// One value for each map.
template <class Value>
struct BySurfaceMap {
  std::array<Value, surface_map_count> values;

  Value& operator[](SurfaceMap map) { return values[static_cast<std::size_t>(map)]; }
  const Value& operator[](SurfaceMap map) const { return values[static_cast<std::size_t>(map)]; }
  bool operator==(const BySurfaceMap&) const = default;
};

/// True where a set of bits, one a map, has that of a map.
constexpr bool has_map(std::uint32_t bits, SurfaceMap map) {
  return (bits >> static_cast<std::uint32_t>(map) & 1u) != 0;
}

/// Indices of images; −1 where there is none.
using SurfaceMapImages = BySurfaceMap<std::int32_t>;
inline constexpr SurfaceMapImages no_surface_maps{{-1, -1, -1}};

}  // namespace septet::scene
