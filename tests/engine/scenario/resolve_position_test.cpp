#include "engine/scenario/run/resolve_position.hpp"

#include <doctest/doctest.h>

#include "tests/engine/scenario/scenario_text.hpp"

namespace septet::scenario {

TEST_CASE("a place is on the road up to the distance beside it that is allowed, and not beyond") {
  const road::RoadNetwork network = test_road();
  const double edge_m = 3 * 3.5;
  const auto is_on_road = [&](double y_m) {
    RigidTransform pose;
    pose.position_m = {100.0, y_m, 0.0};
    return place_at(pose, network, nullptr, 2.0).on_road;
  };
  for (const double side : {1.0, -1.0}) {
    CHECK(is_on_road(side * 0.5 * edge_m));
    CHECK(is_on_road(side * (edge_m + 2.0)));
    CHECK_FALSE(is_on_road(side * (edge_m + 2.001)));
  }
}

}  // namespace septet::scenario
