#include <cmath>
#include <cstddef>
#include <variant>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/roadside/terrain.hpp"
#include "tests/engine/road/crossing_roads.hpp"
#include "tests/engine/scenery/world/drawn_world.hpp"
#include "tests/engine/scenery/world/part_of_world.hpp"

namespace septet::scenery {

TEST_CASE("lawn beside a town's street lies nearly level with it, in bends too") {
  const road::RoadNetwork street =
      road::laid({{.id = "street", .pieces = {{60, 0}, {70, 1.0 / 60}, {40, -1.0 / 90}}, .has_walk = true}});
  const Terrain terrain(RoadShape(street, 0.0), 1);
  int near = 0;
  for (const DrawnTriangle& triangle : drawn_triangles(part_of_world(street, build_verges), "verge"))
    for (const Vec3& corner : triangle.corners_m) {
      const Nearest place = terrain.nearest(Vec2(corner));
      if (place.outside_m > 4.5) continue;
      ++near;
      CHECK(std::abs(corner.z - place.edge_z_m) < 0.1);
    }
  CHECK(near > 200);
}

TEST_CASE("the picture on a retaining wall repeats every 4 m along it, from one piece of the wall to the next") {
  const scene::Store store = part_of_world(road::terraces(), build_verges);
  int pieces = 0;
  for (const auto& [id, node] : store.nodes()) {
    const auto* mesh = std::get_if<scene::GeometryData>(&node.data);
    if (!mesh) continue;
    const scene::GeometryLayer* u = nullptr;
    for (const auto& [layer_id, layer] : mesh->layers)
      if (layer.name == "map_u") u = &layer;
    REQUIRE(u != nullptr);
    for (std::size_t i = 0; i < mesh->polygons.size(); ++i) {
      const auto& corners = mesh->polygons[i];
      if (geometry::corner_count(corners) != 4) continue;
      const auto at = [&](std::size_t k) { return mesh->vertices_m[corners[k % 4]]; };
      const glm::vec3 area = glm::cross(at(2) - at(0), at(3) - at(1));
      if (glm::length(area) < 0.01f || std::abs(area.z) > 0.01f * glm::length(area)) continue;  // Ground.
      ++pieces;
      for (std::size_t k = 0; k < 4; ++k) {
        const float along_m = glm::distance(glm::vec2(at(k)), glm::vec2(at(k + 1)));
        CHECK(std::abs(std::abs(u->reals[i * 4 + (k + 1) % 4] - u->reals[i * 4 + k]) * 4.0f - along_m) < 0.01f);
      }
    }
  }
  CHECK(pieces > 20);
}

}  // namespace septet::scenery
