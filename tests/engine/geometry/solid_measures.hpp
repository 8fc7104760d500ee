#pragma once
/// What makes a mesh the surface of a solid: finite, closed, and its polygons facing outwards; and how many triangles it is.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include <glm/geometric.hpp>

#include "engine/geometry/polygon_mesh.hpp"
#include "engine/math/rigid_transform.hpp"

namespace septet::geometry {

/// True where every edge occurs exactly once in each direction.
inline bool is_closed(const PolygonMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (const PolygonCorners& corners : mesh.polygons) {
    const std::uint32_t count = corner_count(corners);
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t a = corners[k], b = corners[(k + 1) % count];
      if (++balance[{a, b}] > 1) return false;
    }
  }
  for (const auto& [edge, count] : balance)
    if (!balance.contains({edge.second, edge.first})) return false;
  return !mesh.polygons.empty();
}

/// Positive for a closed mesh whose polygons face outwards.
inline double signed_volume_m3(const PolygonMesh& mesh) {
  double six_volumes = 0.0;
  for (const PolygonCorners& corners : mesh.polygons)
    for (std::uint32_t k = 1; k + 1 < corner_count(corners); ++k) {
      const Vec3 a(mesh.vertices_m[corners[0]]), b(mesh.vertices_m[corners[k]]), c(mesh.vertices_m[corners[k + 1]]);
      six_volumes += glm::dot(a, glm::cross(b, c));
    }
  return six_volumes / 6.0;
}

inline bool is_finite(const PolygonMesh& mesh) {
  for (const glm::vec3& p : mesh.vertices_m)
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return false;
  for (const auto& uvs : mesh.corner_uvs)
    for (const glm::vec2& uv : uvs)
      if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return false;
  return true;
}

/// Triangles after `subdivision_level` steps of subdivision.
inline std::size_t triangle_count(const PolygonMesh& mesh, std::uint32_t subdivision_level = 0) {
  std::size_t count = 0;
  for (const PolygonCorners& corners : mesh.polygons)
    // The first step makes a quad of every corner, each further one four of every quad.
    count += subdivision_level == 0 ? corner_count(corners) - 2
                                    : std::size_t{corner_count(corners)} * 2 << 2 * (subdivision_level - 1);
  return count;
}

}  // namespace septet::geometry
