#include "engine/scenery/vehicles/lorry_load.hpp"

#include <cstddef>

#include <doctest/doctest.h>
#include <glm/common.hpp>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "tests/relative.hpp"

namespace septet::scenery {
namespace {

constexpr LoadBay bay{.load = Load::tank, .rear = -2.0f, .front = 6.0f, .half = 1.25f, .height = 3.4f};

struct LoadExtent {
  glm::vec3 low_m{1e9f}, high_m{-1e9f};
};

/// LoadExtent of what is of one finish.
LoadExtent extent_of(Finish finish, DetailLevel level) {
  geometry::MeshBuilder builder;
  add_load(builder, bay, level);
  const geometry::PolygonMesh load = builder.take();
  LoadExtent extent;
  for (std::size_t i = 0; i < load.polygons.size(); ++i) {
    if (load.polygon_materials[i] != index_of(finish)) continue;
    for (std::size_t k = 0; k < geometry::corner_count(load.polygons[i]); ++k) {
      extent.low_m = glm::min(extent.low_m, load.vertices_m[load.polygons[i][k]]);
      extent.high_m = glm::max(extent.high_m, load.vertices_m[load.polygons[i][k]]);
    }
  }
  return extent;
}

}  // namespace

TEST_CASE("a tank fills its bay, and the walkway on top of it ends as far from its front as from its rear") {
  for (const DetailLevel level : {DetailLevel::near, DetailLevel::middle}) {
    const LoadExtent tank = extent_of(Finish::white_panel, level), walkway = extent_of(Finish::trim, level);
    CHECK(tank.high_m.x == relative(bay.front, 1e-6));
    CHECK(tank.low_m.x < bay.rear + 0.1f);
    CHECK(tank.high_m.y < bay.half);
    CHECK(tank.high_m.y > bay.half - 0.1f);
    CHECK(bay.front - walkway.high_m.x == relative(walkway.low_m.x - bay.rear, 1e-5));
    CHECK(walkway.high_m.y == relative(-walkway.low_m.y, 1e-6));
    CHECK(walkway.high_m.z > tank.high_m.z);
    CHECK(walkway.low_m.z < tank.high_m.z);
  }
}

}  // namespace septet::scenery
