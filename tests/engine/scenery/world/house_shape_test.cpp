#include "engine/scenery/world/house_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <doctest/doctest.h>

#include "tests/relative.hpp"

namespace septet::scenery {
namespace {

constexpr roadside::HouseBlock block{.length_m = 12.0, .width_m = 8.0, .x_m = 3.0, .y_m = -2.0};
constexpr HouseLook look{.eaves = 5.6f, .ridge = 8.0f, .wall = Ground::farm_red, .roof = Ground::roof_tiles};

geometry::PolygonMesh lit_windows(double share) {
  geometry::MeshBuilder builder;
  Random random(7);
  add_lit_windows(builder, block, look, share, random);
  return builder.take();
}

}  // namespace

TEST_CASE("a house's four walls stand upright on its block from 1.5 m within the ground to the eaves") {
  geometry::MeshBuilder builder;
  add_house(builder, block, look);
  const geometry::PolygonMesh house = builder.take();
  int walls = 0;
  for (std::size_t i = 0; i < house.polygons.size(); ++i) {
    if (house.polygon_materials[i] != index_of(look.wall) || geometry::corner_count(house.polygons[i]) != 4) continue;
    ++walls;
    std::array<float, 4> heights{};
    for (std::size_t k = 0; k < 4; ++k) {
      const glm::vec3& corner = house.vertices_m[house.polygons[i][k]];
      CHECK(std::abs(corner.x - block.x_m) == relative(block.length_m / 2, 1e-6));
      CHECK(std::abs(corner.y - block.y_m) == relative(block.width_m / 2, 1e-6));
      heights[k] = corner.z;
    }
    std::ranges::sort(heights);
    CHECK(heights[0] == -1.5f);
    CHECK(heights[1] == -1.5f);
    CHECK(heights[2] == look.eaves);
    CHECK(heights[3] == look.eaves);
  }
  CHECK(walls == 4);
}

TEST_CASE("every window of a house is lit but the door's where all are and none where none is") {
  CHECK(lit_windows(0.0).polygons.empty());
  const geometry::PolygonMesh all = lit_windows(1.0);
  // Two floors with three windows along and two across, on two sides each; the door takes one; two panes a window.
  CHECK(all.polygons.size() == (2 * 2 * (3 + 2) - 1) * 2);
  for (const glm::vec3& corner : all.vertices_m) {
    CHECK(corner.z > 0.4f);
    CHECK(corner.z < look.eaves);
  }
}

}  // namespace septet::scenery
