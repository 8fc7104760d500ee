#include "engine/math/pose_keys.hpp"

#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

namespace septet {
namespace {

/// Goes 2 m along x until 1 s while it turns by a quarter about z and doubles, jumps to 5 m, and stands until 3 s.
std::vector<PoseKey> keys() {
  const float half = 0.70710678f;
  return {
      {0.0f, {0, 0, 0}}, {1.0f, {2, 0, 0}, {half, 0, 0, half}, glm::vec3(2.0f)}, {1.0f, {5, 0, 0}}, {3.0f, {5, 0, 0}}};
}

}  // namespace

TEST_CASE("between two keys place and scale go evenly, and the body turns evenly") {
  const PoseKey half = keyed_pose(keys(), 0.5);
  CHECK(half.position_m == glm::vec3(1, 0, 0));
  CHECK(half.scale == glm::vec3(1.5f));
  const glm::vec3 ahead = half.rotation * glm::vec3(1, 0, 0);
  CHECK(glm::distance(ahead, glm::vec3(0.70710678f, 0.70710678f, 0)) < 1e-6f);
}

TEST_CASE("two keys of one time are a jump, and after the last one all begins anew") {
  CHECK(keyed_pose(keys(), 1.0 - 1e-9).position_m.x == doctest::Approx(2.0));
  CHECK(keyed_pose(keys(), 1.0).position_m.x == 5.0f);
  CHECK(keyed_pose(keys(), 3.5).position_m == keyed_pose(keys(), 0.5).position_m);
}

TEST_CASE("before the first key and without a period its pose holds") {
  const std::vector<PoseKey> late{{2.0f, {1, 0, 0}}, {4.0f, {3, 0, 0}}}, still{{0.0f, {7, 0, 0}}};
  CHECK(keyed_pose(late, 1.0).position_m.x == 1.0f);
  CHECK(keyed_pose(still, 100.0).position_m.x == 7.0f);
}

}  // namespace septet
