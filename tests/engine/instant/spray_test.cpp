#include "engine/instant/spray.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/relative.hpp"

namespace septet::instant {
namespace {

DrawnParticipant vehicle_at(double mps, bool heavy) {
  DrawnParticipant vehicle;
  vehicle.number = 7;
  vehicle.velocity_mps = {mps, 0.0, 0.0};
  vehicle.heavy = heavy;
  vehicle.raises_spray = true;
  return vehicle;
}

std::vector<SmokePuff> spray_of(const DrawnParticipant& vehicle, double wetness, double time_s) {
  Environment environment;
  environment.road_wetness = wetness;
  std::vector<SmokePuff> puffs;
  add_spray(vehicle, environment, time_s, puffs);
  return puffs;
}

/// Optical depth through the middles of all puffs, as if they lay on one line.
double depth_along(const std::vector<SmokePuff>& puffs) {
  double depth = 0.0;
  for (const SmokePuff& puff : puffs)
    depth += puff.extinction_area_m2 / (2.0 * std::numbers::pi * puff.radius_m * puff.radius_m);
  return depth;
}

}  // namespace

TEST_CASE("spray rises from wet roads alone, and with the square of the speed") {
  CHECK(spray_of(vehicle_at(25.0, true), 0.0, 8.0).empty());
  CHECK(spray_of(vehicle_at(7.0, true), 1.0, 8.0).empty());
  DrawnParticipant still = vehicle_at(25.0, false);
  still.raises_spray = false;
  CHECK(spray_of(still, 1.0, 8.0).empty());
  const double slow = spray_depth(vehicle_at(16.0, false), 1.0), fast = spray_depth(vehicle_at(25.0, false), 1.0);
  CHECK(slow / fast == doctest::Approx((16.0 * 16.0 - 64.0) / (25.0 * 25.0 - 64.0)));
  CHECK(spray_depth(vehicle_at(25.0, true), 0.5) < spray_depth(vehicle_at(25.0, true), 1.0));
  CHECK(spray_depth(vehicle_at(NAN, true), 1.0) == 0.0f);
  CHECK(spray_of(vehicle_at(25.0, true), 1.0, NAN).empty());
}

TEST_CASE("what hangs behind a vehicle takes as much light as its spray is computed to, at every instant") {
  for (const bool heavy : {false, true})
    for (double time_s = 8.0; time_s < 8.4; time_s += 0.03) {
      const DrawnParticipant vehicle = vehicle_at(25.0, heavy);
      CHECK(depth_along(spray_of(vehicle, 1.0, time_s)) == relative(spray_depth(vehicle, 1.0), 0.15));
    }
  // Share of light taken by a lorry's spray at 90 km/h in standing water: two thirds to three quarters.
  CHECK(1.0 - std::exp(-spray_depth(vehicle_at(25.0, true), 1.0)) == relative(0.7, 0.05));
}

TEST_CASE(
    "spray hangs behind its vehicle, a lorry's higher and longer than a car's, and is the same when asked again") {
  for (const bool heavy : {false, true}) {
    const std::vector<SmokePuff> puffs = spray_of(vehicle_at(25.0, heavy), 1.0, 8.05);
    REQUIRE(!puffs.empty());
    double mean_m = 0.0, all = 0.0;
    for (const SmokePuff& puff : puffs) {
      CHECK(puff.position_m.x <= 0.0);
      CHECK(std::abs(puff.position_m.y) < 1.5);
      CHECK(puff.position_m.z > 0.0);
      CHECK(puff.position_m.z + puff.radius_m < (heavy ? 5.0 : 2.2));
      const double depth = puff.extinction_area_m2 / (puff.radius_m * puff.radius_m);
      mean_m -= depth * puff.position_m.x;
      all += depth;
    }
    CHECK(mean_m / all > (heavy ? 15.0 : 5.0));
    CHECK(mean_m / all < (heavy ? 40.0 : 20.0));
    const std::vector<SmokePuff> again = spray_of(vehicle_at(25.0, heavy), 1.0, 8.05);
    REQUIRE(again.size() == puffs.size());
    for (std::size_t i = 0; i < puffs.size(); ++i) {
      CHECK(again[i].position_m == puffs[i].position_m);
      CHECK(again[i].seed == puffs[i].seed);
    }
  }
}

TEST_CASE("a puff of spray keeps its place and its size from frame to frame, and only its age grows") {
  const DrawnParticipant before = vehicle_at(25.0, true);
  DrawnParticipant after = before;
  after.world_from_vehicle.position_m.x += 25.0 * 0.01;
  const std::vector<SmokePuff> one = spray_of(before, 1.0, 8.05), other = spray_of(after, 1.0, 8.06);
  REQUIRE(one.size() == other.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    CHECK(one[i].seed == other[i].seed);
    CHECK(glm::length(one[i].position_m - other[i].position_m) < 0.12);
  }
}

}  // namespace septet::instant
