#include "engine/geometry/mesh_builder.hpp"

#include <cmath>
#include <numbers>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/geometry/mesh_measures.hpp"
#include "engine/geometry/noise.hpp"
#include "engine/geometry/shapes.hpp"
#include "tests/engine/geometry/solid_measures.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::geometry;

namespace {

/// A quad and a triangle beside it, flat on the ground, their edges creased one by one.
PolygonMesh kite() {
  MeshBuilder builder;
  for (const glm::vec3& p : {glm::vec3(0, 0, 0), {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0.5f, 0}}) builder.vertex(p);
  builder.quad(0, 1, 2, 3, {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}});
  builder.triangle(1, 4, 2, {{{1, 0}, {2, 0.5f}, {1, 1}}});
  PolygonMesh mesh = builder.take();
  mesh.edge_creases = {{10, 11, 12, 13}, {20, 21, 22, 0}};
  return mesh;
}

}  // namespace

TEST_CASE("a mirroring transform turns polygons round and each corner and edge keeps what was its own") {
  const PolygonMesh mesh = kite();
  const PolygonMesh mirrored = mirrored_y(mesh);
  REQUIRE(mirrored.polygons.size() == 2);
  CHECK(mirrored.polygons[0] == PolygonCorners{0, 3, 2, 1});
  CHECK(mirrored.polygons[1] == PolygonCorners{1, 2, 4, no_vertex});
  // The edge from 0 to 3 was that from 3 to 0.
  CHECK(mirrored.edge_creases[0] == std::array<std::uint32_t, 4>{13, 12, 11, 10});
  CHECK(mirrored.edge_creases[1] == std::array<std::uint32_t, 4>{22, 21, 20, 0});
  for (std::size_t i = 0; i < 2; ++i)
    for (std::uint32_t k = 0; k < corner_count(mesh.polygons[i]); ++k)
      for (std::uint32_t j = 0; j < corner_count(mesh.polygons[i]); ++j)
        if (mirrored.polygons[i][k] == mesh.polygons[i][j]) CHECK(mirrored.corner_uvs[i][k] == mesh.corner_uvs[i][j]);
  for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i)
    CHECK(mirrored.vertices_m[i] == mesh.vertices_m[i] * glm::vec3(1, -1, 1));
}

TEST_CASE("a transform that mirrors nothing leaves polygons as they are") {
  const glm::mat4 half_turn = glm::rotate(glm::mat4(1.0f), std::numbers::pi_v<float>, glm::vec3(0, 0, 1));
  const PolygonMesh turned = transformed(kite(), half_turn);
  CHECK(turned.polygons == kite().polygons);
  CHECK(turned.edge_creases == kite().edge_creases);
  CHECK(glm::distance(turned.vertices_m[4], glm::vec3(-2, -0.5f, 0)) < 1e-6f);
}

TEST_CASE("an edge is creased in every polygon that has it and whichever way it is named") {
  for (const bool turned : {false, true}) {
    PolygonMesh mesh = kite();
    crease_edge(mesh, turned ? 2 : 1, turned ? 1 : 2, 77);
    CHECK(mesh.edge_creases[0] == std::array<std::uint32_t, 4>{10, 77, 12, 13});
    CHECK(mesh.edge_creases[1] == std::array<std::uint32_t, 4>{20, 21, 77, 0});
  }
}

TEST_CASE("an edge is sharp where the surface turns by more than the angle and not where by less") {
  for (const float fold_rad : {0.4f, 0.6f}) {
    MeshBuilder builder;
    for (const glm::vec3& p : {glm::vec3(0, 0, 0), {0, 1, 0}, {-1, 1, 0}, {-1, 0, 0}}) builder.vertex(p);
    builder.vertex({std::cos(fold_rad), 0, std::sin(fold_rad)});
    builder.vertex({std::cos(fold_rad), 1, std::sin(fold_rad)});
    builder.quad(0, 1, 2, 3);
    builder.quad(1, 0, 4, 5);
    PolygonMesh mesh = builder.take();
    crease_by_angle(mesh, 0.5f);
    const std::uint32_t expected = fold_rad > 0.5f ? crease_sharp : crease_smooth;
    CHECK(mesh.edge_creases[0] == std::array<std::uint32_t, 4>{expected, 0, 0, 0});
    CHECK(mesh.edge_creases[1] == std::array<std::uint32_t, 4>{expected, 0, 0, 0});
  }
}

TEST_CASE("what is appended keeps its own coordinates and creases behind what was there") {
  MeshBuilder builder;
  builder.patch({0, 0, 9}, {1, 0, 9}, {1, 1, 9}, {0, 1, 9});
  builder.append(kite());
  builder.append(box({0, 0, 0}, {1, 1, 1}));
  const PolygonMesh& mesh = builder.mesh();
  CHECK(mesh.edge_creases[0] == std::array<std::uint32_t, 4>{});
  CHECK(mesh.edge_creases[1] == kite().edge_creases[0]);
  CHECK(mesh.edge_creases[3][0] == crease_sharp);
  CHECK(mesh.corner_uvs[2] == kite().corner_uvs[1]);
  CHECK(mesh.corner_uvs[3] == box({0, 0, 0}, {1, 1, 1}).corner_uvs[0]);
  CHECK(mesh.polygons[2][3] == no_vertex);
  for (std::uint32_t k = 0; k < 4; ++k) CHECK(mesh.polygons[3][k] >= 9);
}

TEST_CASE("what is appended to nothing keeps its creases too") {
  MeshBuilder edges, all;
  edges.append(kite());
  CHECK(edges.mesh().edge_creases == kite().edge_creases);
  all.append(box({0, 0, 0}, {1, 1, 1}));
  all.patch({0, 0, 9}, {1, 0, 9}, {1, 1, 9}, {0, 1, 9});
  REQUIRE(all.mesh().edge_creases.size() == 7);
  CHECK(all.mesh().edge_creases[0][0] == crease_sharp);
  CHECK(all.mesh().edge_creases[6][0] == crease_smooth);
}

TEST_CASE("texture coordinates of a box are metres on each of its sides") {
  PolygonMesh mesh = box({0, 0, 0}, {3, 2, 1});
  project_box_uvs(mesh, 0.5f);
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i)
    for (std::uint32_t k = 0; k < 4; ++k) {
      const glm::vec3 p = 0.5f * mesh.vertices_m[mesh.polygons[i][k]];
      const glm::vec3 opposite = 0.5f * mesh.vertices_m[mesh.polygons[i][(k + 2) % 4]];
      const glm::vec2 uv = mesh.corner_uvs[i][k];
      CAPTURE(i);
      if (p.x == opposite.x)
        CHECK(uv == glm::vec2(p.y, -p.z));
      else if (p.y == opposite.y)
        CHECK(uv == glm::vec2(p.x, -p.z));
      else
        CHECK(uv == glm::vec2(p.x, p.y));
    }
}

TEST_CASE("texture coordinates of what is turned or drawn along a path grow with its way") {
  const std::array<LathePoint, 2> profile{{{1.0f, 0.0f}, {1.0f, 2.0f}}};
  const PolygonMesh tube = lathe(profile, 8);
  for (std::size_t i = 0; i < 8; ++i)
    for (std::uint32_t k = 0; k < 4; ++k) {
      const glm::vec3 p = tube.vertices_m[tube.polygons[i][k]];
      const float turn = std::atan2(p.y, p.x) / (2.0f * std::numbers::pi_v<float>);
      const glm::vec2 uv = tube.corner_uvs[i][k];
      CHECK(std::abs(uv.x - turn - std::round(uv.x - turn)) < 1e-5f);
      CHECK(uv.y == -p.z);
      CHECK(uv.x <= static_cast<float>(i + 1) / 8.0f + 1e-6f);
      CHECK(uv.x >= static_cast<float>(i) / 8.0f - 1e-6f);
    }
  const std::array<glm::vec2, 3> line{{{0, 0}, {3, 0}, {3, 4}}};
  const std::array<PathFrame, 2> path{{{{5, 0, 0}, {0, -1, 0}, {0, 0, 1}, 5}, {{9, 0, 0}, {0, -1, 0}, {0, 0, 1}, 9}}};
  const PolygonMesh band = extrude(line, path, false, false);
  REQUIRE(band.polygons.size() == 2);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::uint32_t k = 0; k < 4; ++k) {
      const glm::vec3 p = band.vertices_m[band.polygons[i][k]];
      CHECK(band.corner_uvs[i][k] == glm::vec2(-p.y + p.z, p.x));
    }
}

TEST_CASE("a mesh with a hole or two polygons on one side of an edge is not closed") {
  PolygonMesh mesh = box({0, 0, 0}, {1, 1, 1});
  CHECK(is_closed(mesh));
  CHECK_FALSE(is_closed(PolygonMesh{}));
  PolygonMesh doubled = mesh;
  doubled.polygons.push_back(mesh.polygons.front());
  CHECK_FALSE(is_closed(doubled));
  mesh.polygons.pop_back();
  CHECK_FALSE(is_closed(mesh));
  CHECK(is_finite(mesh));
  mesh.corner_uvs[2][1].y = NAN;
  CHECK_FALSE(is_finite(mesh));
}

TEST_CASE("a subdivided polygon has two triangles for each corner and four times as many each further step") {
  CHECK(triangle_count(kite()) == 3);
  CHECK(triangle_count(kite(), 1) == 2 * 7);
  CHECK(triangle_count(kite(), 2) == 4 * 2 * 7);
  CHECK(triangle_count(kite(), 3) == 16 * 2 * 7);
}

TEST_CASE("gradient noise is smooth and bounded and its mean is nothing and an octave is half as strong") {
  double sum = 0.0, most = 0.0;
  for (int i = 0; i < 200; ++i)
    for (int k = 0; k < 200; ++k) {
      const double x = 0.237 * i - 20.0, y = 0.191 * k - 15.0, here = gradient_noise(x, y, 3);
      sum += here;
      most = std::max(most, std::abs(here));
      constexpr double h = 1e-4;
      CHECK(std::abs(gradient_noise(x + h, y, 3) - here) < 4.0 * h);
      CHECK(std::abs(gradient_noise(x, y + h, 3) - here) < 4.0 * h);
    }
  CHECK(std::abs(sum / 40000.0) < 0.02);
  CHECK(most > 0.6);
  CHECK(most < 0.85);
  // Level across a lattice line: the second difference there is that beside it.
  for (int i = 0; i < 40; ++i) {
    const double y = 0.31 * i, h = 1e-3;
    const auto slope = [&](double x) { return (gradient_noise(x + h, y, 3) - gradient_noise(x, y, 3)) / h; };
    CHECK(std::abs(slope(7.0) - slope(7.0 - h)) < 0.02);
  }
  CHECK(fractal_noise(0.3, 0.4, 1, 5) == gradient_noise(0.3, 0.4, 5));
  CHECK(fractal_noise(0.3, 0.4, 2, 5) ==
        relative(gradient_noise(0.3, 0.4, 5) + 0.5 * gradient_noise(0.6, 0.8, 5 + 7919), 1e-12));
}

TEST_CASE("random numbers of a lattice are even and neighbours and seeds have nothing to do with each other") {
  double sum = 0.0, squares = 0.0, along = 0.0, across = 0.0, seeds = 0.0;
  constexpr int n = 200;
  for (int y = -n / 2; y < n / 2; ++y)
    for (int x = -n / 2; x < n / 2; ++x) {
      const double r = lattice_random(x, y, 1) - 0.5;
      CHECK(r >= -0.5);
      CHECK(r < 0.5);
      sum += r;
      squares += r * r;
      along += r * (lattice_random(x + 1, y, 1) - 0.5);
      across += r * (lattice_random(x, y + 1, 1) - 0.5);
      seeds += r * (lattice_random(x, y, 2) - 0.5);
    }
  // Of 40,000 numbers each mean has a deviation of 0.0015 or, of the products, of 0.0004.
  CHECK(std::abs(sum / (n * n)) < 0.006);
  CHECK(squares / (n * n) == relative(1.0 / 12.0, 0.02));
  CHECK(std::abs(along / (n * n)) < 0.002);
  CHECK(std::abs(across / (n * n)) < 0.002);
  CHECK(std::abs(seeds / (n * n)) < 0.002);
}
