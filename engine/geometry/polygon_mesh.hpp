#pragma once
/// A mesh of triangles and quads with creases, as modelled, before subdivision and triangulation.
///
/// The single primitive of the Verse platform (Brink, Steenberg and Svensson 2006, §2.5.1), either drawn as it is or
/// used as the control cage of a subdivision surface. Metres, the frame of the object that will carry it. Polygons are
/// counter-clockwise seen from the front.
///
/// Crease values are the Verse's: 0 is smooth, 0xFFFFFFFF is sharp, between them smoothness falls linearly (see
/// subdivision.hpp). A border edge is always sharp.

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace septet::geometry {

inline constexpr std::uint32_t no_vertex = 0xFFFFFFFFu;
inline constexpr std::uint32_t crease_smooth = 0;
inline constexpr std::uint32_t crease_sharp = 0xFFFFFFFFu;

/// Indices of four vertices; a triangle's last is `no_vertex`.
using PolygonCorners = std::array<std::uint32_t, 4>;

inline bool is_triangle(const PolygonCorners& corners) { return corners[3] == no_vertex; }
inline std::uint32_t corner_count(const PolygonCorners& corners) { return is_triangle(corners) ? 3 : 4; }

struct PolygonMesh {
  std::vector<glm::vec3> vertices_m;
  std::vector<PolygonCorners> polygons;
  std::vector<std::array<glm::vec2, 4>> corner_uvs;         ///< Empty, or one entry a polygon.
  std::vector<std::array<glm::vec2, 4>> second_corner_uvs;  ///< The same, for images that lie otherwise than the first.
  /// Empty, or one entry a polygon, as scene::SurfaceVertex packs them. A subdivided mesh has neither, nor second uvs.
  std::vector<std::array<std::uint32_t, 4>> corner_colors, corner_tangents;
  std::vector<std::uint32_t> polygon_materials;  ///< Empty (all 0), or one index a polygon.

  std::uint32_t default_vertex_crease = crease_smooth;
  std::uint32_t default_edge_crease = crease_smooth;  ///< `crease_sharp`: every facet is flat.
  std::vector<std::uint32_t> vertex_creases;          ///< Empty (all default), or one a vertex.
  /// Empty (all default), or one entry a polygon: value k belongs to the edge from corner k to the
  /// next corner. Where the two polygons at an edge differ, the sharper value counts.
  std::vector<std::array<std::uint32_t, 4>> edge_creases;
};

}  // namespace septet::geometry
