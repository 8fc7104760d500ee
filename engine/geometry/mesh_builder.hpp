#pragma once
/// Builds a PolygonMesh polygon by polygon; all generated shapes are made with it.
///
/// Polygons take the builder's current material. Corners are given counter-clockwise seen from the front. Texture
/// coordinates are optional; a mesh has them for every polygon or (0, 0) where a polygon had none. Metres.

#include <array>
#include <span>

#include <glm/mat4x4.hpp>

#include "engine/geometry/polygon_mesh.hpp"

namespace septet::geometry {

using CornerUvs = std::array<glm::vec2, 4>;

class MeshBuilder {
 public:
  std::uint32_t material = 0;

  std::uint32_t vertex(const glm::vec3& position_m) {
    mesh_.vertices_m.push_back(position_m);
    return static_cast<std::uint32_t>(mesh_.vertices_m.size() - 1);
  }
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, const CornerUvs& uvs = {});
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, const CornerUvs& uvs = {});
  /// Four new vertices and their quad.
  void patch(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d,
             const CornerUvs& uvs = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}});
  /// Adds a copy of `part`, its points moved by `to_builder`. Its materials are kept, or all
  /// become the current one if `recolor`.
  void append(const PolygonMesh& part, const glm::mat4& to_builder = glm::mat4(1.0f), bool recolor = false);

  const PolygonMesh& mesh() const { return mesh_; }
  PolygonMesh take() { return std::move(mesh_); }

 private:
  void polygon(const PolygonCorners& corners, const CornerUvs& uvs);
  PolygonMesh mesh_;
};

/// Marks every edge sharp at which the surface turns by more than `angle_rad`, and leaves the
/// others as they are. Borders are not touched (they are sharp anyway).
void crease_by_angle(PolygonMesh& mesh, float angle_rad);

/// Marks the edge between two vertices in every polygon that has it.
void crease_edge(PolygonMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t value = crease_sharp);

/// Moves, turns and scales; a mirroring transform also reverses the polygons.
PolygonMesh transformed(const PolygonMesh& mesh, const glm::mat4& transform);

/// A copy for the other side: y becomes −y.
PolygonMesh mirrored_y(const PolygonMesh& mesh);

/// Replaces texture coordinates by the projection along the main axis of each polygon, in metres times `per_metre`.
void project_box_uvs(PolygonMesh& mesh, float per_metre);

}  // namespace septet::geometry
