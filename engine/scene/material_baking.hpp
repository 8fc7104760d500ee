#pragma once
/// Pictures of what varies over a surface in a material's tree, so that every renderer shows the same.
///
/// A tree that depends on the surface's coordinates alone, in a way that numbers and one bitmap cannot say, is
/// evaluated at each pixel of the unit square of map_u and map_v; beyond it the pictures repeat. What depends on light
/// and view stays a number (material_constants.hpp). CONVENTIONS.md, "Materials". Pure functions; `bake_material`
/// uses all cores.

#include <cstdint>
#include <functional>
#include <optional>
#include <set>

#include "engine/scene/material_evaluation.hpp"
#include "engine/scene/node.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::scene {

/// Pixels of a picture's side: of a tree without textures, and at most with larger ones. A tree of many fragments has
/// fewer, so that no tree costs more than `most_evaluations` of a fragment.
inline constexpr std::uint32_t baked_side = 256, most_baked_side = 1024;
inline constexpr std::uint64_t most_evaluations = std::uint64_t{1} << 23;
/// Different bitmaps and layers that one tree reads; further ones are black.
inline constexpr std::size_t most_read_pictures = 16;

/// True for a tree that numbers and bitmaps of its own cannot say.
bool is_to_be_baked(const Node& material);

/// The bitmaps that its textures name, whether they exist or not.
std::set<NodeId> bitmaps_of(const Node& material);

/// Absent pictures: the quantity is the same all over.
struct BakedSurface {
  SurfaceNumbers numbers;                  ///< The pictures multiply them.
  std::optional<TextureImage> base_color;  ///< Alpha: opacity, of that in the numbers.
  std::optional<TextureImage> emission;
  std::optional<TextureImage> properties;  ///< As SurfaceMap::properties.
};

/// `bitmap` returns a node, or null.
BakedSurface bake_material(const Node& material, const std::function<const Node*(NodeId)>& bitmap);

}  // namespace septet::scene
