#pragma once
/// What a mesh is: finite, closed, which way out, how large, how many triangles.

#include <glm/vec3.hpp>

#include "engine/geometry/polygon_mesh.hpp"

namespace septet::geometry {

bool is_finite(const PolygonMesh& mesh);

/// Every edge is run along exactly once in each direction.
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
