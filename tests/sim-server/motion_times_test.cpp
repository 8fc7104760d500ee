#include "sim-server/drive/motion_times.hpp"

#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

namespace septet::server {
namespace {

using namespace scene;

MotionSet asked(NodeId node) { return {node, {.legs = {{0.0, {1, 0, 0}}, {2.0, {0, 1, 0}}}}, true}; }

void must_apply(Store& store, const Command& command) { REQUIRE(store.apply(command).has_value()); }

}  // namespace

TEST_CASE("a motion from now begins at the tick that does it where the object is then") {
  Store store;
  must_apply(store, NodeCreate{1});
  must_apply(store, TransformSet{1, {{5, 6, 7}}});
  must_apply(store, NodeCreate{2});
  must_apply(store, MotionSet{2, {{10, 0, 0}, {1, 0, 0, 0}, {{1.0, {4, 0, 0}}}}});
  std::vector<Command> batch = {asked(1), asked(2), NodeCreate{3}, TransformSet{3, {{0, 0, 9}}}, asked(3), asked(4)};
  put_true_times(store, batch, 3.0);
  const auto motion = [&](std::size_t of) { return std::get<MotionSet>(batch[of]); };
  for (const std::size_t of : {std::size_t{0}, std::size_t{1}, std::size_t{4}}) {
    CHECK_FALSE(motion(of).from_now);
    CHECK(motion(of).motion.legs[0].from_s == 3.0);
    CHECK(motion(of).motion.legs[1].from_s == 5.0);
  }
  CHECK(motion(0).motion.position_m == Vec3(5, 6, 7));
  CHECK(glm::distance(motion(1).motion.position_m, Vec3(18, 0, 0)) < 1e-12);
  CHECK(motion(4).motion.position_m == Vec3(0, 0, 9));
  CHECK_FALSE(store.apply(batch[5]).has_value());  // Nobody knows where node 4 is.
}

}  // namespace septet::server
