// Land beside the roads for wheels: without a jump from the road into the fields, at its drawn height, and as rough as
// a meadow.
#include "engine/roadside/ground_beside.hpp"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/roadside/plants.hpp"
#include "tests/engine/road/road_files.hpp"
#include "tests/relative.hpp"

namespace septet::roadside {
namespace {

const Terrain& land_beside_motorway() {
  static const Terrain terrain(RoadShape(road::motorway(), usual_overrun_m), 1);
  return terrain;
}

/// Point beside the right edge of the motorway.
Vec2 beside(double s_m, double out_m) {
  const road::RoadExtent extent = road::road_extent(road::motorway().roads[0], s_m);
  return Vec2(road::evaluate(road::motorway(), {0, s_m, extent.right_t_m - out_m}).position_m);
}

double height_at(const Vec2& p) { return ground_beside(road::motorway(), land_beside_motorway(), p, nullptr).height_m; }

}  // namespace

TEST_CASE("from the road's edge into the fields the ground goes without a jump") {
  for (const double s_m : {300.0, 1400.0, 3100.0, 4700.0}) {
    CAPTURE(s_m);
    const road::RoadExtent extent = road::road_extent(road::motorway().roads[0], s_m);
    double last_m = road::evaluate(road::motorway(), {0, s_m, extent.right_t_m}).position_m.z;
    for (double out_m = 0.01; out_m < 90.0; out_m += 0.1) {
      const double here_m = height_at(beside(s_m, out_m));
      CAPTURE(out_m);
      CHECK(std::abs(here_m - last_m) < 0.06);
      last_m = here_m;
    }
  }
}

TEST_CASE("far from the roads the ground is the drawn land with the unevenness of a meadow") {
  double sum_m2 = 0.0;
  int count = 0;
  for (double s_m = 200.0; s_m < 6000.0; s_m += 100.0) {
    for (const double out_m : {80.0, 200.0}) {
      const Vec2 corner = glm::round(beside(s_m, out_m) / land_cell_m) * land_cell_m;
      if (land_beside_motorway().nearest(corner).outside_m < 45.0) continue;
      const double over_m = height_at(corner) - land_beside_motorway().height_m(corner);
      CHECK(std::abs(over_m - unevenness_m(corner)) < 1e-9);
      sum_m2 += over_m * over_m;
      ++count;
    }
  }
  REQUIRE(count > 50);
  // Integral of class E between 0.05 and 1 cycle a metre.
  CHECK(std::sqrt(sum_m2 / count) == relative(std::sqrt(4096e-6 * 0.01 * 19.0), 0.35));
}

TEST_CASE("the unevenness has the variance of its class and no mean") {
  double sum_m = 0.0, sum_m2 = 0.0;
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i) {
    const double z_m = unevenness_m({0.37 * i, 0.61 * (i % 997)});
    sum_m += z_m;
    sum_m2 += z_m * z_m;
  }
  CHECK(std::abs(sum_m / count) < 0.003);
  CHECK(sum_m2 / count == relative(4096e-6 * 0.01 * 19.0, 0.1));
}

TEST_CASE("the normal is that of the heights around") {
  const Vec2 p = beside(1000.0, 30.0);
  const GroundBeside ground = ground_beside(road::motorway(), land_beside_motorway(), p, nullptr);
  CHECK(glm::length(ground.normal) == doctest::Approx(1.0));
  CHECK(-ground.normal.x / ground.normal.z == doctest::Approx((height_at(p + Vec2(0.3, 0.0)) - ground.height_m) / 0.3));
  CHECK(-ground.normal.y / ground.normal.z == doctest::Approx((height_at(p + Vec2(0.0, 0.3)) - ground.height_m) / 0.3));
}

TEST_CASE("grass is more slippery and rolls worse than a road") {
  CHECK(meadow().friction < 0.6);
  CHECK(meadow().rolling_resistance > 3.0);
}

}  // namespace septet::roadside
