#include "engine/raytrace/geometry.hpp"

#include <vector>

#include <doctest/doctest.h>

namespace septet::raytrace {

TEST_CASE("a hit names the place, its distance and its triangle, also where several places have one mesh") {
  std::vector<scene::SurfaceVertex> corners(3);
  corners[0].position_m = {-1.0f, -1.0f, 0.0f};
  corners[1].position_m = {1.0f, -1.0f, 0.0f};
  corners[2].position_m = {0.0f, 1.0f, 0.0f};
  const std::vector<std::uint32_t> indices{0, 1, 2};
  auto geometry = Geometry::create();
  REQUIRE(geometry.has_value());
  geometry->add_mesh(corners, indices, false);
  const glm::mat3 twice(2.0f);
  const std::vector<Place> places{{0},
                                  {.mesh = 0, .origin_m = {10.0f, 0.0f, 1.0f}},
                                  {.mesh = 0, .origin_m = {20.0f, 0.0f, 2.0f}, .turn = twice},
                                  {.mesh = 0, .origin_m = {30.0f, 0.0f, 3.0f}, .seen = false}};
  geometry->place(places, nullptr);
  for (std::uint32_t n = 0; n < 4; ++n) {
    CAPTURE(n);
    const float z = static_cast<float>(n);
    const Ray down{.origin_m = {10.0f * z, 0.0f, 5.0f}, .direction = {0.0f, 0.0f, -1.0f}};
    Hit hit;
    const bool found = geometry->intersect(down, hit);
    CHECK(found == (n < 3));
    CHECK(geometry->unshadowed(down) == 0.0f);
    if (!found) continue;
    CHECK(hit.place == n);
    CHECK(hit.triangle == 0);
    CHECK(hit.distance_m == doctest::Approx(5.0f - z));
  }
  Hit hit;
  CHECK_FALSE(geometry->intersect({.origin_m = {5.0f, 0.0f, 5.0f}, .direction = {0.0f, 0.0f, -1.0f}}, hit));
}

}  // namespace septet::raytrace
