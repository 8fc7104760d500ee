#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/engine/scenery/world/drawn_world.hpp"

namespace septet::scenery {
namespace {

const scene::Store& country() {
  static const scene::Store store = [] {
    scene::Store made;
    scene::SceneBuilder builder(made);
    build_road_world(builder, third_party_road("straight_500m"), 3,
                     {.vegetation = false, .buildings = false, .overrun_m = 300.0});
    return made;
  }();
  return store;
}

using Corner = std::pair<std::int64_t, std::int64_t>;
Corner corner_of(const Vec3& p) { return {std::llround(p.x * 16.0), std::llround(p.y * 16.0)}; }

}  // namespace

TEST_CASE("fields meet along their own borders and not along the squares of the land") {
  // Edges between two ground covers, by their direction relative to the grid.
  std::map<std::pair<Corner, Corner>, std::set<std::string>> sides;
  for (const DrawnTriangle& triangle : drawn_triangles(country(), "land"))
    for (std::size_t k = 0; k < 3; ++k) {
      Corner a = corner_of(triangle.corners_m[k]), b = corner_of(triangle.corners_m[(k + 1) % 3]);
      if (b < a) std::swap(a, b);
      sides[{a, b}].insert(triangle.material);
    }
  double squared = 0.0, oblique = 0.0;
  for (const auto& [edge, materials] : sides) {
    // The verge ends at a distance from the road, which runs along the grid.
    if (materials.size() < 2 || materials.contains("world/verge")) continue;
    const double dx = static_cast<double>(edge.second.first - edge.first.first),
                 dy = static_cast<double>(edge.second.second - edge.first.second);
    (std::min(std::abs(dx), std::abs(dy)) < 2.0 ? squared : oblique) += std::hypot(dx, dy) / 16.0;
  }
  CHECK(oblique > 5000.0);
  CHECK(squared < 0.15 * oblique);
}

TEST_CASE("a wood's roof ends below the tips of the trees at its border") {
  std::map<Corner, double> roof;
  int tips = 0, floating = 0;
  const std::vector<DrawnTriangle> wood = drawn_triangles(country(), "wood");
  for (const DrawnTriangle& triangle : wood)
    if (triangle.material == "world/canopy")
      for (const Vec3& corner : triangle.corners_m) roof[corner_of(corner)] = corner.z;
  for (const DrawnTriangle& triangle : wood) {
    if (triangle.material != "world/wood edge") continue;
    const double high = std::max({triangle.corners_m[0].z, triangle.corners_m[1].z, triangle.corners_m[2].z});
    for (const Vec3& corner : triangle.corners_m) {
      const auto above = roof.find(corner_of(corner));
      if (above == roof.end() || corner.z < high - 5.0) continue;
      ++tips;
      floating += corner.z - above->second < 5.0;
    }
  }
  CHECK(tips > 100);
  CHECK(floating == 0);
}

}  // namespace septet::scenery
