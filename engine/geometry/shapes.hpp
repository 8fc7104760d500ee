#pragma once
/// Basic shapes of scenery. All are closed and face outwards unless said otherwise; texture coordinates are in metres
/// (1 m = 1) unless said otherwise.

#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/geometry/polygon_mesh.hpp"

namespace septet::geometry {

/// A box. `bevel_m` > 0 cuts its edges by flat chamfers of that size.
PolygonMesh box(const glm::vec3& min_m, const glm::vec3& max_m, float bevel_m = 0.0f);

/// A point of a lathe's profile: distance from the axis and height along it.
struct LathePoint {
  float radius_m = 0.0f;
  float height_m = 0.0f;
};

/// `profile` from low to high on the right-hand side, turned about the z axis. A point of radius 0
/// closes an end in one vertex; open ends stay open. u runs once round, v with height.
PolygonMesh lathe(std::span<const LathePoint> profile, std::uint32_t sides);

/// A cylinder along z with both ends closed.
PolygonMesh cylinder(float radius_m, float low_m, float high_m, std::uint32_t sides);

/// One cross-section along the path of an extrusion: the profile's (x, y) are placed along right and up.
struct PathFrame {
  glm::vec3 position_m;
  glm::vec3 right, up;
  float length_m = 0.0f;  ///< Along the path so far: the texture's v.
};

/// `profile` carried along `path`. Seen along the path, its front is to the right of the profile's direction: a
/// counter-clockwise tube (`closed` joins the last point to the first) faces outwards, a sheet from right to left faces
/// up. `cap` closes a convex tube's ends. u is the length along the profile, v the length along the path.
PolygonMesh extrude(std::span<const glm::vec2> profile, std::span<const PathFrame> path, bool closed, bool cap = false);

/// An icosahedron whose triangles are split `splits` times; radius 1, 20·4^splits triangles.
/// Texture coordinates wrap it like a globe, without a seam repair: for textures of noise.
PolygonMesh icosphere(std::uint32_t splits);

}  // namespace septet::geometry
