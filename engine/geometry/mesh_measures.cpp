#include "engine/geometry/mesh_measures.hpp"

#include <glm/common.hpp>

namespace septet::geometry {

Bounds bounds(const PolygonMesh& mesh) {
  Bounds result;
  for (const glm::vec3& p : mesh.vertices_m) {
    result.min_m = glm::min(result.min_m, p);
    result.max_m = glm::max(result.max_m, p);
  }
  return result;
}

}  // namespace septet::geometry
