#pragma once
/// Properties of a mesh: finite, closed, orientation, size, number of triangles.

#include <glm/vec3.hpp>

#include "engine/geometry/polygon_mesh.hpp"

namespace septet::geometry {

bool is_finite(const PolygonMesh& mesh);

/// True where every edge occurs exactly once in each direction.
bool is_closed(const PolygonMesh& mesh);

/// Positive for a closed mesh whose polygons face outwards.
double signed_volume_m3(const PolygonMesh& mesh);

/// Triangles after `subdivision_level` steps of subdivision.
std::size_t triangle_count(const PolygonMesh& mesh, std::uint32_t subdivision_level = 0);

struct Bounds {
  glm::vec3 min_m{1e30f}, max_m{-1e30f};
};
Bounds bounds(const PolygonMesh& mesh);

}  // namespace septet::geometry
