#pragma once
/// Properties of a scene that hold for all its instants: materials with holes, with visible backs, and plain ones, and
/// the material of each triangle.

#include <cstdint>
#include <vector>

#include "engine/scene/resolved_scene.hpp"

namespace septet::raytrace {

inline constexpr float opaque_from = 0.999f;  ///< Least alpha of an opaque material, as in the rasteriser.
inline constexpr float rough_from = 0.6f;     ///< Roughness from which no mirroring is visible.

struct SceneIndex {
  explicit SceneIndex(const scene::ResolvedScene& scene);
  std::vector<bool> cut;            ///< For each material, whether its image has holes.
  std::vector<bool> shows_back;     ///< For each material, whether it is visible from behind.
  std::vector<std::uint8_t> plain;  ///< For each material, whether it is a matt colour and no more.
  std::vector<bool> open;           ///< For each mesh, whether a ray may pass in places: holes, or glass.
  /// For each mesh its triangles' materials, by their index; one number for all of them, if they are of one.
  std::vector<std::vector<std::uint32_t>> materials;
};

/// The material of each triangle of a mesh; one number for all of them, if they are of one.
std::vector<std::uint32_t> triangle_materials(const scene::SurfaceMesh& mesh);

}  // namespace septet::raytrace
