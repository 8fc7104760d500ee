#pragma once
/// Properties of a scene that hold for all its instants: materials with holes, with visible backs, and plain ones, and
/// the material of each triangle.

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/scene/resolved_scene.hpp"

namespace septet::raytrace {

using scene::opaque_from;
inline constexpr float rough_from = 0.6f;  ///< Roughness from which no mirroring is visible.

struct SceneIndex {
  explicit SceneIndex(const scene::ResolvedScene& scene);
  std::vector<bool> cut;                 ///< By material: true if its image has holes.
  std::vector<bool> shows_back;          ///< By material: true if it is visible from behind.
  std::vector<std::uint8_t> plain;       ///< By material: 1 if it is a matt colour and no more.
  std::vector<glm::vec3> lamp_emission;  ///< By material: its mean emission (instant::mean_emissions).
  std::vector<bool> open;                ///< By mesh: true if a ray may pass in places: holes, or glass.
  /// Materials of the triangles, by mesh and triangle; one number for all of them, if they are of one.
  std::vector<std::vector<std::uint32_t>> materials;
};

/// The material of each triangle of a mesh; one number for all of them, if they are of one.
std::vector<std::uint32_t> triangle_materials(const scene::SurfaceMesh& mesh);

}  // namespace septet::raytrace
