#pragma once
/// Size of a mesh.

#include <glm/vec3.hpp>

#include "engine/geometry/polygon_mesh.hpp"

namespace septet::geometry {

struct Bounds {
  glm::vec3 min_m{1e30f}, max_m{-1e30f};
};
Bounds bounds(const PolygonMesh& mesh);

}  // namespace septet::geometry
