#include "engine/geometry/shapes.hpp"

#include <array>
#include <numbers>

#include <doctest/doctest.h>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/mesh_measures.hpp"
#include "engine/geometry/noise.hpp"
#include "tests/engine/geometry/solid_measures.hpp"
#include "tests/relative.hpp"

namespace septet::geometry {

TEST_CASE("a box is closed and holds its volume with bevels and without") {
  const PolygonMesh plain = box({-1, -2, 0}, {1, 2, 3});
  CHECK(is_closed(plain));
  CHECK(signed_volume_m3(plain) == doctest::Approx(24.0));
  CHECK(triangle_count(plain) == 12);
  const PolygonMesh beveled = box({-1, -2, 0}, {1, 2, 3}, 0.1f);
  CHECK(is_closed(beveled));
  CHECK(signed_volume_m3(beveled) < 24.0);
  CHECK(signed_volume_m3(beveled) > 23.7);
  CHECK(bounds(beveled).max_m.z == doctest::Approx(3.0));
}

TEST_CASE("a lathe and a cylinder and an icosphere are closed and face outwards") {
  CHECK(is_closed(cylinder(0.5f, 0.0f, 2.0f, 48)));
  CHECK(signed_volume_m3(cylinder(0.5f, 0.0f, 2.0f, 48)) == relative(0.5 * std::numbers::pi, 0.01));
  const PolygonMesh ball = icosphere(3);
  CHECK(triangle_count(ball) == 1280);
  CHECK(is_closed(ball));
  CHECK(signed_volume_m3(ball) == relative(4.0 / 3.0 * std::numbers::pi, 0.02));
}

TEST_CASE("a closed profile extruded along a path is a closed tube") {
  const std::array<glm::vec2, 4> square{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  const std::array<PathFrame, 3> path{{{{0, 0, 0}, {0, -1, 0}, {0, 0, 1}, 0},
                                       {{5, 0, 0}, {0, -1, 0}, {0, 0, 1}, 5},
                                       {{9, 0, 0}, {0, -1, 0}, {0, 0, 1}, 9}}};
  const PolygonMesh tube = extrude(square, path, true, true);
  CHECK(is_closed(tube));
  CHECK(signed_volume_m3(tube) == doctest::Approx(36.0));
}

TEST_CASE("a mirrored mesh still faces outwards") {
  const PolygonMesh mirrored = mirrored_y(box({0, 1, 0}, {1, 2, 1}, 0.05f));
  CHECK(is_closed(mirrored));
  CHECK(signed_volume_m3(mirrored) > 0.9);
  CHECK(bounds(mirrored).max_m.y == doctest::Approx(-1.0));
}

TEST_CASE("creasing by angle marks the edges of a cylinder's ends and not its side") {
  const PolygonMesh mesh = cylinder(1.0f, 0.0f, 1.0f, 16);
  int sharp = 0;
  for (const auto& creases : mesh.edge_creases)
    for (const std::uint32_t crease : creases) sharp += crease == crease_sharp;
  CHECK(sharp == 2 * 2 * 16);
}

TEST_CASE("appending keeps materials unless they are recoloured") {
  PolygonMesh part = box({0, 0, 0}, {1, 1, 1});
  part.polygon_materials.assign(6, 3);
  MeshBuilder builder;
  builder.material = 1;
  builder.append(part);
  builder.append(part, glm::translate(glm::mat4(1.0f), glm::vec3(2, 0, 0)), true);
  CHECK(builder.mesh().polygon_materials.front() == 3);
  CHECK(builder.mesh().polygon_materials.back() == 1);
  CHECK(builder.mesh().edge_creases.size() == 12);
  CHECK(bounds(builder.mesh()).max_m.x == doctest::Approx(3.0));
  CHECK(is_closed(builder.mesh()));
}

TEST_CASE("noise that repeats is the same one period on and differs with the seed") {
  for (int i = 0; i < 50; ++i) {
    const double x = 0.37 * i, y = 0.11 * i;
    CHECK(fractal_noise(x, y, 4, 5, 8) == doctest::Approx(fractal_noise(x + 8, y - 16, 4, 5, 8)));
  }
  CHECK(fractal_noise(0.4, 0.7, 4, 5) != fractal_noise(0.4, 0.7, 4, 6));
  CHECK(gradient_noise(3.0, -7.0, 1) == 0.0);
}

}  // namespace septet::geometry
