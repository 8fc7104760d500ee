#include <algorithm>

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/scenery/vehicles/cockpit_parts.hpp"

namespace septet::scenery {

TEST_CASE("the driver's hands and forearms lie within an arm's reach of the steering wheel") {
  float furthest_m = 0.0f;
  for (const glm::vec3& point : hands().vertices_m) furthest_m = glm::max(furthest_m, glm::length(point));
  CHECK(furthest_m > 0.187f);  // The rim, on which they lie.
  CHECK(furthest_m < 0.42f);   // An elbow is 0.36 m from the wheel's middle, and 5 cm thick.
}

TEST_CASE("each of the driver's hands is the other's mirror image") {
  const auto points = hands().vertices_m;
  for (const glm::vec3& point : points) {
    const glm::vec3 mirrored(point.x, -point.y, point.z);
    CHECK(std::ranges::any_of(points, [&](const glm::vec3& other) { return glm::distance(other, mirrored) < 1e-4f; }));
  }
}

}  // namespace septet::scenery
