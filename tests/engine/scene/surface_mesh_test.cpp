#include "engine/scene/surface_mesh.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/scene/builder.hpp"

using namespace septet;
using namespace septet::scene;

namespace {

using geometry::no_vertex;
using geometry::PolygonMesh;

std::uint32_t same_material(std::uint32_t index) { return index; }

}  // namespace

TEST_CASE("a normal is weighted by the angle of each polygon at the vertex and not by how many there are") {
  // Three walls meet in a corner; one of them is cut into two triangles.
  PolygonMesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}};
  mesh.polygons = {{0, 1, 4, no_vertex}, {0, 4, 2, no_vertex}, {0, 2, 3, no_vertex}, {0, 3, 1, no_vertex}};
  const SurfaceMesh surface = triangulate(mesh, same_material);
  const auto corner = std::find_if(surface.vertices.begin(), surface.vertices.end(),
                                   [](const auto& vertex) { return vertex.position_m == glm::vec3(0.0f); });
  REQUIRE(corner != surface.vertices.end());
  CHECK(glm::distance(corner->normal, glm::normalize(glm::vec3(1.0f))) < 1e-5f);
}

TEST_CASE("a polygon of four corners is cut along its shorter diagonal") {
  PolygonMesh mesh;
  mesh.vertices_m = {{-3, 0, 0}, {0, -1, 0}, {3, 0, 0}, {0, 1, 0}};
  mesh.polygons = {{0, 1, 2, 3}};
  const SurfaceMesh surface = triangulate(mesh, same_material);
  REQUIRE(surface.indices.size() == 6);
  // Each triangle has both ends of the short diagonal and one end of the long one.
  for (const std::size_t first : {0u, 3u}) {
    int of_short = 0;
    for (std::size_t k = 0; k < 3; ++k) of_short += surface.vertices[surface.indices[first + k]].position_m.x == 0.0f;
    CHECK(of_short == 2);
  }
}

TEST_CASE("corners with unlike texture coordinates or a crease between them are vertices of their own") {
  PolygonMesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};
  mesh.polygons = {{0, 1, 2, 3}, {1, 4, 5, 2}};
  CHECK(triangulate(mesh, same_material).vertices.size() == 6);
  mesh.corner_uvs = {{glm::vec2(0, 0), {1, 0}, {1, 1}, {0, 1}}, {glm::vec2(1, 0), {2, 0}, {2, 1}, {1, 1}}};
  CHECK(triangulate(mesh, same_material).vertices.size() == 6);
  mesh.corner_uvs[1][0] = {1.001f, 0};
  CHECK(triangulate(mesh, same_material).vertices.size() == 7);
  mesh.corner_uvs.clear();
  mesh.vertex_creases.assign(6, 0);
  mesh.vertex_creases[1] = 0x80000000u;
  CHECK(triangulate(mesh, same_material).vertices.size() == 7);
  mesh.vertex_creases[1] = 0x7FFFFFFFu;
  CHECK(triangulate(mesh, same_material).vertices.size() == 6);
}

TEST_CASE("polygons that are turned against each other share no normal") {
  PolygonMesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};
  mesh.polygons = {{0, 1, 2, 3}, {1, 2, 5, 4}};
  CHECK(triangulate(mesh, same_material).vertices.size() == 8);
}

TEST_CASE("polygons that make no sense are left out with what belongs to them") {
  GeometryData geometry;
  geometry.vertices_m.resize(4);
  geometry.polygons = {
      {0, 1, 4, no_vertex}, {0, 1, 1, no_vertex}, {0, 1, 2, 3}, {no_vertex, 0, 1, 2}, {1, 2, 3, no_vertex}};
  geometry.layers[0] = {"material", LayerType::face_byte, 0, 0.0f, {10, 11, 12, 13, 14}, {}};
  const PolygonMesh mesh = polygons_of(geometry);
  REQUIRE(mesh.polygon_materials.size() == mesh.polygons.size());
  CHECK(mesh.polygons.front() == PolygonCorners{0, 1, 2, 3});
  CHECK(mesh.polygon_materials.front() == 12);
  CHECK(mesh.polygons.back() == PolygonCorners{1, 2, 3, no_vertex});
  CHECK(mesh.polygon_materials.back() == 14);
}

TEST_CASE("whoever asks for more than four levels of subdivision gets four") {
  Store store;
  SceneBuilder build(store);
  PolygonMesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.polygons = {{0, 1, 2, 3}};
  const NodeId node = build.add_mesh("", mesh, {.subdivision_level = 9});
  CHECK(surface_of_geometry(*store.find(node), same_material).indices.size() == 256 * 6);
}

TEST_CASE("colours, tangents and second coordinates of corners come through the scene, and part vertices") {
  PolygonMesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.polygons = {{0, 1, 2, no_vertex}, {0, 2, 3, no_vertex}};
  mesh.corner_colors.assign(2, {1, 2, 3, white_vertex});
  mesh.corner_tangents.assign(2, {7, 7, 7, 0});
  mesh.second_corner_uvs.assign(2, {glm::vec2(0.25f), {0.5f, 0.25f}, {0.5f, 0.5f}, {0, 0}});
  Store store;
  SceneBuilder builder(store);
  const Node* node = store.find(builder.add_mesh("plate", mesh));
  REQUIRE(node);
  const SurfaceMesh surface = surface_of_geometry(*node, same_material);
  // Corners 0 and 2 of the first are corners 0 and 1 of the second: the last of these has other values.
  REQUIRE(surface.vertices.size() == 5);
  CHECK(surface.vertices[1].color == 2);
  CHECK(surface.vertices[1].tangent == 7);
  CHECK(surface.vertices[1].second_uv == glm::vec2(0.5f, 0.25f));
  mesh.corner_colors.clear();
  mesh.corner_tangents.clear();
  const SurfaceMesh plain = triangulate(mesh, same_material);
  CHECK(plain.vertices[0].color == white_vertex);
  CHECK(plain.vertices[0].tangent == 0);
}
