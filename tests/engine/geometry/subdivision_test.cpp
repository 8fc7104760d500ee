#include "engine/geometry/subdivision.hpp"

#include <algorithm>
#include <map>

#include <doctest/doctest.h>

using namespace septet::geometry;

namespace {

PolygonMesh cube() {
  PolygonMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices_m.push_back({i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f});
  mesh.polygons = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return mesh;
}

PolygonMesh tetrahedron() {
  PolygonMesh mesh;
  mesh.vertices_m = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  mesh.polygons = {{0, 1, 2, no_vertex}, {0, 2, 3, no_vertex}, {0, 3, 1, no_vertex}, {1, 3, 2, no_vertex}};
  return mesh;
}

bool has_vertex(const PolygonMesh& mesh, glm::vec3 wanted, float within = 1e-5f) {
  return std::any_of(mesh.vertices_m.begin(), mesh.vertices_m.end(), [&](glm::vec3 v) {
    return std::abs(v.x - wanted.x) < within && std::abs(v.y - wanted.y) < within && std::abs(v.z - wanted.z) < within;
  });
}

constexpr std::uint32_t half = 0x80000000u;

}  // namespace

TEST_CASE("a smooth cube is refined to the points of Catmull and Clark") {
  const PolygonMesh refined = subdivide(cube(), 1).value();
  CHECK(refined.polygons.size() == 24);
  CHECK(refined.vertices_m.size() == 26);
  CHECK(has_vertex(refined, {0, 0, 1}));                                // (v + v + v + v) / 4
  CHECK(has_vertex(refined, {0, 0.75f, 0.75f}));                        // (v + v + f + f) / 4
  CHECK(has_vertex(refined, {5.0f / 9.0f, 5.0f / 9.0f, 5.0f / 9.0f}));  // (F + 2R) / 3 with n = 3
}

TEST_CASE("a cube of sharp edges stays a cube at every level") {
  PolygonMesh cage = cube();
  cage.default_edge_crease = crease_sharp;
  for (const std::uint32_t levels : {1u, 2u, 3u}) {
    const PolygonMesh refined = subdivide(cage, levels).value();
    CHECK(has_vertex(refined, {1, 1, 1}));
    for (const glm::vec3& v : refined.vertices_m)
      CHECK(std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) == doctest::Approx(1.0));
  }
}

TEST_CASE("a half crease lies half way between smooth and sharp") {
  PolygonMesh cage = cube();
  cage.default_edge_crease = half;
  const PolygonMesh refined = subdivide(cage, 1).value();
  CHECK(has_vertex(refined, {0, 0.875f, 0.875f}));
  CHECK(has_vertex(refined, {7.0f / 9.0f, 7.0f / 9.0f, 7.0f / 9.0f}));
}

TEST_CASE("a crease has the same weight at every level") {
  PolygonMesh cage = cube();
  cage.default_edge_crease = half;
  const PolygonMesh once = subdivide(cage, 1).value();
  std::map<std::uint32_t, int> creases;
  for (const auto& values : once.edge_creases)
    for (const std::uint32_t value : values) ++creases[value];
  CHECK(creases == std::map<std::uint32_t, int>{{0, 48}, {half, 48}});
  // The corner c of level 1 has three half creased edges, whose other ends lie at (0 e e) and its
  // turns, and three faces, each with the point of an old face (0 0 1).
  const float c = 7.0f / 9.0f, e = 0.875f;
  const float face_mean = ((c + 2 * e + 1) / 4 + 2 * (c + e) / 4) / 3;
  const float edge_mean = (c / 2 + 2 * (c + e) / 2) / 3;
  const float smooth = (face_mean + 2 * edge_mean) / 3;
  const float twice = 0.5f * c + 0.5f * smooth;
  CHECK(has_vertex(subdivide(cage, 2).value(), {twice, twice, twice}));
}

TEST_CASE("a sharp vertex stays where it is and a half sharp one moves half as far") {
  PolygonMesh cage = cube();
  cage.vertex_creases.assign(8, crease_smooth);
  cage.vertex_creases[7] = crease_sharp;
  cage.vertex_creases[0] = half;
  const PolygonMesh refined = subdivide(cage, 1).value();
  CHECK(has_vertex(refined, {1, 1, 1}));
  CHECK(has_vertex(refined, {-7.0f / 9.0f, -7.0f / 9.0f, -7.0f / 9.0f}));
  CHECK(has_vertex(subdivide(cage, 3).value(), {1, 1, 1}));
}

TEST_CASE("triangles are refined by the scheme of Loop") {
  const PolygonMesh refined = subdivide(tetrahedron(), 1).value();
  CHECK(refined.polygons.size() == 16);
  CHECK(std::all_of(refined.polygons.begin(), refined.polygons.end(), is_triangle));
  // An edge point is 3/8 of its ends and 1/8 of the two opposite corners; a vertex of valence 3
  // keeps 7/16.
  CHECK(has_vertex(refined, {0.5f, 0, 0}));
  CHECK(has_vertex(refined, {0.25f, 0.25f, 0.25f}));
}

TEST_CASE("triangles and quads mix and give quads") {
  PolygonMesh house = cube();  // one side cut into triangles
  house.polygons[1] = {4, 5, 7, no_vertex};
  house.polygons.push_back({4, 7, 6, no_vertex});
  const PolygonMesh refined = subdivide(house, 2).value();
  CHECK(refined.polygons.size() == (5 * 4 + 2 * 3) * 4);
  CHECK(std::none_of(refined.polygons.begin(), refined.polygons.end(), is_triangle));
}

TEST_CASE("a border is sharp and its plane is kept") {
  PolygonMesh sheet;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x) sheet.vertices_m.push_back({x, y, 0});
  for (std::uint32_t y = 0; y < 2; ++y)
    for (std::uint32_t x = 0; x < 2; ++x)
      sheet.polygons.push_back({y * 3 + x, y * 3 + x + 1, y * 3 + x + 4, y * 3 + x + 3});
  const PolygonMesh refined = subdivide(sheet, 2).value();
  CHECK(has_vertex(refined, {1, 0, 0}));  // the middle of a straight border edge
  for (const glm::vec3& v : refined.vertices_m) CHECK(std::abs(v.z) < 1e-6f);
}

TEST_CASE("texture coordinates stay linear in each polygon and materials are inherited") {
  PolygonMesh cage = cube();
  for (std::uint32_t p = 0; p < 6; ++p) {
    cage.corner_uvs.push_back({glm::vec2(0, 0), {1, 0}, {1, 1}, {0, 1}});
    cage.polygon_materials.push_back(p);
  }
  const PolygonMesh refined = subdivide(cage, 2).value();
  REQUIRE(refined.corner_uvs.size() == 96);
  std::map<std::uint32_t, int> faces;
  double area = 0.0;
  for (std::size_t p = 0; p < 96; ++p) {
    ++faces[refined.polygon_materials[p]];
    const auto& uv = refined.corner_uvs[p];
    const glm::vec2 a = uv[2] - uv[0], b = uv[3] - uv[1];
    CHECK(a.x * b.y - a.y * b.x == doctest::Approx(2.0 / 16.0));
    area += 0.5 * (a.x * b.y - a.y * b.x);
  }
  CHECK(area == doctest::Approx(6.0));
  CHECK(faces == std::map<std::uint32_t, int>{{0, 16}, {1, 16}, {2, 16}, {3, 16}, {4, 16}, {5, 16}});
}

TEST_CASE("a cage that names a vertex that is not there is refused") {
  PolygonMesh cage = cube();
  cage.polygons[0][1] = 8;
  CHECK_FALSE(subdivide(cage, 1).has_value());
}

TEST_CASE("where two polygons name one edge's crease differently the sharper one holds") {
  const auto refined = [](std::uint32_t first, std::uint32_t second) {
    PolygonMesh cage = cube();
    cage.edge_creases.assign(cage.polygons.size(), {});
    cage.edge_creases[0][3] = first;   // The edge of 1 and 0 in the first polygon,
    cage.edge_creases[2][0] = second;  // and of 0 and 1 in the third.
    return subdivide(cage, 1).value().vertices_m;
  };
  CHECK(refined(crease_sharp, half) == refined(crease_sharp, crease_sharp));
  CHECK(refined(half, crease_sharp) == refined(crease_sharp, crease_sharp));
  CHECK(refined(half, half) != refined(crease_sharp, crease_sharp));
}
