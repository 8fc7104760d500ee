#pragma once
/// Normals of shading that lean away from the viewer.

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace septet::raytrace {

/// Turns a smoothed or mapped normal back to the silhouette where it faces away from the viewer and the triangle does
/// not. Both unit.
inline glm::vec3 facing_viewer(const glm::vec3& normal, const glm::vec3& ray_direction) {
  const float facing = -glm::dot(normal, ray_direction);
  return facing < 1e-3f ? glm::normalize(normal - (1e-3f - facing) * ray_direction * 1.01f) : normal;
}

}  // namespace septet::raytrace
