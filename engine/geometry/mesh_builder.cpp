#include "engine/geometry/mesh_builder.hpp"

#include <cmath>
#include <map>
#include <utility>

#include <glm/geometric.hpp>

#include "engine/core/check.hpp"

namespace septet::geometry {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

glm::vec3 area_vector(const PolygonMesh& mesh, const PolygonCorners& corners) {
  const auto at = [&](std::uint32_t k) { return mesh.vertices_m[corners[k]]; };
  if (is_triangle(corners)) return glm::cross(at(1) - at(0), at(2) - at(0));
  return glm::cross(at(2) - at(0), at(3) - at(1));
}

void give_edge_creases(PolygonMesh& mesh) {
  const std::uint32_t value = mesh.default_edge_crease;
  mesh.edge_creases.resize(mesh.polygons.size(), {value, value, value, value});
}

}  // namespace

void MeshBuilder::polygon(const PolygonCorners& corners, const CornerUvs& uvs) {
  for (std::uint32_t k = 0; k < corner_count(corners); ++k)
    SEPTET_CHECK(corners[k] < mesh_.vertices_m.size(), "corner {} of {} vertices", corners[k], mesh_.vertices_m.size());
  mesh_.polygons.push_back(corners);
  mesh_.corner_uvs.push_back(uvs);
  mesh_.polygon_materials.push_back(material);
  if (!mesh_.edge_creases.empty()) give_edge_creases(mesh_);
}

void MeshBuilder::quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, const CornerUvs& uvs) {
  polygon({a, b, c, d}, uvs);
}

void MeshBuilder::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, const CornerUvs& uvs) {
  polygon({a, b, c, no_vertex}, uvs);
}

void MeshBuilder::patch(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d,
                        const CornerUvs& uvs) {
  const std::uint32_t first = vertex(a);
  vertex(b);
  vertex(c);
  vertex(d);
  quad(first, first + 1, first + 2, first + 3, uvs);
}

void MeshBuilder::append(const PolygonMesh& part, const glm::mat4& to_builder, bool recolor) {
  const auto offset = static_cast<std::uint32_t>(mesh_.vertices_m.size());
  // Creases of its own edges, or of earlier parts; a builder without polygons shows neither by its content.
  const bool creased = !mesh_.edge_creases.empty() || !part.edge_creases.empty() ||
                       part.default_edge_crease != mesh_.default_edge_crease;
  if (creased) give_edge_creases(mesh_);
  for (const glm::vec3& p : part.vertices_m) mesh_.vertices_m.push_back(glm::vec3(to_builder * glm::vec4(p, 1.0f)));
  for (std::size_t i = 0; i < part.polygons.size(); ++i) {
    PolygonCorners corners = part.polygons[i];
    for (std::uint32_t k = 0; k < corner_count(corners); ++k) corners[k] += offset;
    mesh_.polygons.push_back(corners);
    mesh_.corner_uvs.push_back(part.corner_uvs.empty() ? CornerUvs{} : part.corner_uvs[i]);
    mesh_.polygon_materials.push_back(recolor || part.polygon_materials.empty() ? material : part.polygon_materials[i]);
    if (creased) {
      const std::uint32_t value = part.default_edge_crease;
      mesh_.edge_creases.push_back(part.edge_creases.empty() ? std::array{value, value, value, value}
                                                             : part.edge_creases[i]);
    }
  }
}

void crease_by_angle(PolygonMesh& mesh, float angle_rad) {
  give_edge_creases(mesh);
  // The polygon and corner on each directed edge; the neighbour has the edge in the opposite direction.
  std::map<Edge, std::pair<std::size_t, std::uint32_t>> sides;
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i) {
    const std::uint32_t count = corner_count(mesh.polygons[i]);
    for (std::uint32_t k = 0; k < count; ++k) sides[{mesh.polygons[i][k], mesh.polygons[i][(k + 1) % count]}] = {i, k};
  }
  for (const auto& [edge, side] : sides) {
    const auto other = sides.find({edge.second, edge.first});
    if (other == sides.end()) continue;
    const glm::vec3 a = area_vector(mesh, mesh.polygons[side.first]);
    const glm::vec3 b = area_vector(mesh, mesh.polygons[other->second.first]);
    const float lengths = glm::length(a) * glm::length(b);
    if (lengths > 0.0f && glm::dot(a, b) < lengths * std::cos(angle_rad))
      mesh.edge_creases[side.first][side.second] = crease_sharp;
  }
}

void crease_edge(PolygonMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t value) {
  give_edge_creases(mesh);
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i) {
    const std::uint32_t count = corner_count(mesh.polygons[i]);
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t from = mesh.polygons[i][k], to = mesh.polygons[i][(k + 1) % count];
      if ((from == a && to == b) || (from == b && to == a)) mesh.edge_creases[i][k] = value;
    }
  }
}

PolygonMesh transformed(const PolygonMesh& mesh, const glm::mat4& transform) {
  PolygonMesh result = mesh;
  for (glm::vec3& p : result.vertices_m) p = glm::vec3(transform * glm::vec4(p, 1.0f));
  if (glm::determinant(glm::mat3(transform)) >= 0.0f) return result;
  for (std::size_t i = 0; i < result.polygons.size(); ++i) {
    // Corner 0 stays, the others change places: (0 1 2 3) becomes (0 3 2 1), edges likewise.
    const std::uint32_t last = corner_count(result.polygons[i]) - 1;
    std::swap(result.polygons[i][1], result.polygons[i][last]);
    if (!result.corner_uvs.empty()) std::swap(result.corner_uvs[i][1], result.corner_uvs[i][last]);
    if (!result.edge_creases.empty()) {
      auto& creases = result.edge_creases[i];
      std::swap(creases[0], creases[last]);
      if (last == 3) std::swap(creases[1], creases[2]);
    }
  }
  return result;
}

PolygonMesh mirrored_y(const PolygonMesh& mesh) {
  glm::mat4 mirror(1.0f);
  mirror[1][1] = -1.0f;
  return transformed(mesh, mirror);
}

void project_box_uvs(PolygonMesh& mesh, float per_metre) {
  mesh.corner_uvs.assign(mesh.polygons.size(), CornerUvs{});
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i) {
    const glm::vec3 normal = glm::abs(area_vector(mesh, mesh.polygons[i]));
    for (std::uint32_t k = 0; k < corner_count(mesh.polygons[i]); ++k) {
      const glm::vec3 p = mesh.vertices_m[mesh.polygons[i][k]] * per_metre;
      glm::vec2 uv(p.x, p.y);
      if (normal.x >= normal.y && normal.x >= normal.z)
        uv = {p.y, -p.z};
      else if (normal.y >= normal.z)
        uv = {p.x, -p.z};
      mesh.corner_uvs[i][k] = uv;
    }
  }
}

}  // namespace septet::geometry
