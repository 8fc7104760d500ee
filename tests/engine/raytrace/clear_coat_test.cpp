/// Clear coat by paths; tests/engine/render/clear_coat_slow_test.cpp has the rasteriser's.

#include <cmath>
#include <utility>

#include <doctest/doctest.h>

#include "tests/engine/raytrace/traced_scenes.hpp"
#include "tests/relative.hpp"

namespace septet::raytrace {

TEST_CASE("under an even sky a black board with a clear coat is as bright as glass mirrors, and one without is black") {
  scene::SurfaceMaterial material;
  material.base_color = glm::vec3(0.0f);
  material.roughness = 0.8f;
  const auto seen = [&](float clear_coat, double down_rad) {
    material.clear_coat = clear_coat;
    scene::ResolvedScene scene;
    scene.materials.push_back(material);
    scene::SurfaceMesh board;
    const glm::vec3 a{-90, -90, -3}, b{90, -90, -3}, c{90, 90, -3}, d{-90, 90, -3};
    add_triangle(board, {a, b, c});
    add_triangle(board, {a, c, d});
    board.parts.push_back({0, 6, 0});
    board.bounds_min_m = a, board.bounds_max_m = c;
    scene.meshes.push_back(std::move(board));
    scene.instances.push_back({});
    instant::Instant instant = instant_from({0.0, 0.0, 0.0}, 0.004, 8, even_sky(1.0f));
    instant.views.front().projection = instant::symmetric_view({0.0, 0.0, 0.0}, 0.0, -down_rad, 0.004, 0.004);
    return mean_of(traced(scene, instant, {.samples = 64, .filter = Filter::box})).radiance.y;
  };
  for (const double down_rad : {0.3, 0.6, 1.2}) {
    CAPTURE(down_rad);
    const double fresnel = 0.04 + 0.96 * std::pow(1.0 - std::sin(down_rad), 5.0);
    CHECK(seen(1.0f, down_rad) == relative(fresnel, 0.04));
    CHECK(seen(0.5f, down_rad) == relative(0.5 * fresnel, 0.04));
    CHECK(seen(0.0f, down_rad) == 0.0);
  }
}

}  // namespace septet::raytrace
