#include "engine/scene/solid_box.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/scene/builder.hpp"
#include "tests/why_not.hpp"

namespace septet::scene {
namespace {

/// 2 m along x, 1 m across, 3 m up, from its origin on.
geometry::PolygonMesh block() {
  geometry::PolygonMesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 3}};
  mesh.polygons = {{0, 1, 2, 3}};
  return mesh;
}

struct Scene {
  Store store;
  SceneBuilder build{store};
  NodeId mesh = build.add_mesh("block", block());
  NodeId wall = build.add_object("stimuli/wall", {.geometry = mesh});

  Scene() {
    apply(TagGroupSet{wall, 5, "body"});
    apply(TagSet{wall, 5, 0, {"solid", true}});
  }
  void apply(const Command& command) { REQUIRE(store.apply(command).has_value()); }
  ReadSolid read() const {
    const auto solid = read_solid(store, wall);
    REQUIRE_MESSAGE(solid.has_value(), why_not(solid));
    return *solid;
  }
};

Quat about_vertical(double rad) { return glm::angleAxis(rad, Vec3(0.0, 0.0, 1.0)); }

}  // namespace

TEST_CASE("a solid's box is what its mesh measures, scaled, and heads as the object does") {
  Scene scene;
  CHECK(is_tagged_solid(*scene.store.find(scene.wall)));
  scene.apply(
      TransformSet{scene.wall, {{10.0, 20.0, 1.0}, about_vertical(std::numbers::pi / 2.0), {2.0f, 1.0f, 0.5f}}});
  const ReadSolid solid = scene.read();
  REQUIRE(solid.box.has_value());
  CHECK(solid.box->heading_rad == doctest::Approx(std::numbers::pi / 2.0));
  CHECK(glm::distance(solid.box->size_m, Vec3(4.0, 1.0, 1.5)) < 1e-6);
  // Its middle is 2 m along and half a metre to the left.
  CHECK(glm::distance(solid.box->foot_m, Vec3(9.5, 22.0, 1.0)) < 1e-6);
}

TEST_CASE("a solid's box holds what hangs below the object, and what leans") {
  Scene scene;
  const NodeId shelf = scene.build.add_object("stimuli/shelf", {.geometry = scene.mesh});
  scene.apply(TransformSet{shelf, {{3.0, 0.0, 0.0}}});
  scene.apply(LinkSet{scene.wall, 9, {"child", shelf, 0}});
  CHECK(glm::distance(scene.read().box->size_m, Vec3(5.0, 1.0, 3.0)) < 1e-6);
  CHECK(parent_of(scene.store, shelf) == scene.wall);
  CHECK_FALSE(parent_of(scene.store, scene.wall).has_value());
  scene.apply(HideSet{shelf, true});
  CHECK(glm::distance(scene.read().box->size_m, Vec3(2.0, 1.0, 3.0)) < 1e-6);
  scene.apply(TransformSet{scene.wall, {Vec3(0.0), glm::angleAxis(std::numbers::pi / 2.0, Vec3(1.0, 0.0, 0.0))}});
  CHECK(glm::distance(scene.read().box->size_m, Vec3(2.0, 3.0, 1.0)) < 1e-6);
}

TEST_CASE("what is hidden, or has no shape, has no box") {
  Scene scene;
  scene.apply(HideSet{scene.wall, true});
  CHECK_FALSE(scene.read().box.has_value());
  scene.apply(HideSet{scene.wall, false});
  const ReadSolid before = scene.read();
  CHECK(is_as_read(scene.store, before.read_from));
  scene.apply(NodeDestroy{scene.mesh});
  CHECK_FALSE(is_as_read(scene.store, before.read_from));
  CHECK_FALSE(scene.read().box.has_value());
}

TEST_CASE("a solid that is turned about the vertical has a box that turns with it about its origin") {
  Scene scene;
  MotionSet motion{scene.wall, {.position_m = {5.0, 0.0, 0.0}}};
  motion.motion.legs.push_back({.from_s = 2.0, .velocity_mps = {1.0, 0.0, 0.0}, .turn_radps = {0.0, 0.0, 0.5}});
  scene.apply(motion);
  const ReadSolid solid = scene.read();
  REQUIRE(solid.box.has_value());
  CHECK(glm::distance(solid.box->foot_m, Vec3(6.0, 0.5, 0.0)) < 1e-6);
  CHECK(glm::distance(solid.box->size_m, Vec3(2.0, 1.0, 3.0)) < 1e-6);
  CHECK(solid.about_m == Vec3(5.0, 0.0, 0.0));
  CHECK(solid.legs == motion.motion.legs);
}

TEST_CASE("a solid that rolls has a box along its axis that holds it in all its turns and does not turn") {
  Scene scene;
  MotionSet motion{scene.wall, {.rotation = about_vertical(0.3)}};
  motion.motion.legs.push_back({.velocity_mps = {1.0, 0.0, 0.0}, .turn_radps = {0.0, 2.0, 0.0}});
  scene.apply(motion);
  const ReadSolid solid = scene.read();
  REQUIRE(solid.box.has_value());
  CHECK(solid.box->heading_rad == doctest::Approx(std::numbers::pi / 2.0));
  REQUIRE(solid.legs.size() == 1);
  CHECK(solid.legs.front().turn_radps == Vec3(0.0));
  const Vec3 half_m = 0.5 * solid.box->size_m;
  const Quat upright_from_world = about_vertical(-solid.box->heading_rad);
  for (double time_s = 0.0; time_s < 3.0; time_s += 0.1) {
    const RigidTransform now = pose_at(motion.motion, time_s).world_from_object;
    const Vec3 foot_m = solid.box->foot_m + Vec3(time_s, 0.0, 0.0);
    for (const Vec3 corner_m : {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 1, 0), Vec3(0, 1, 3)}) {
      const Vec3 seen_m = upright_from_world * (now * corner_m - foot_m) - Vec3(0.0, 0.0, half_m.z);
      CHECK(std::abs(seen_m.x) <= half_m.x + 1e-6);
      CHECK(std::abs(seen_m.y) <= half_m.y + 1e-6);
      CHECK(std::abs(seen_m.z) <= half_m.z + 1e-6);
    }
  }
}

TEST_CASE("a solid's mass is a number of its range, and another one is refused") {
  Scene scene;
  CHECK_FALSE(scene.read().mass_kg.has_value());
  scene.apply(TagSet{scene.wall, 5, 1, {"mass_kg", 12.5}});
  CHECK(scene.read().mass_kg == 12.5);
  for (const TagValue& value :
       {TagValue(0.0), TagValue(-1.0), TagValue(1e9), TagValue(std::uint32_t{5}), TagValue(std::string("5"))}) {
    scene.apply(TagSet{scene.wall, 5, 1, {"mass_kg", value}});
    const auto refused = read_solid(scene.store, scene.wall);
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().what.find("from 0.1 to 20000 kg") != std::string::npos);
  }
}

TEST_CASE("an object is posed by its box as it stood with it, turned and moved as the box") {
  Scene scene;
  scene.apply(TransformSet{scene.wall, {{10.0, 20.0, 1.0}, about_vertical(0.4), {2.0f, 1.0f, 1.0f}}});
  const ReadSolid before = scene.read();
  scene.apply(TagSet{scene.wall, 5, 1, {"mass_kg", 12.5}});
  scene.apply(TagSet{scene.wall, 5, 2, {"participant", std::uint32_t{32768}}});
  const Vec3 foot_m = about_vertical(-0.4) * (before.box->foot_m - before.about_m);
  scene.apply(TagSet{scene.wall, 5, 3, {"foot_m", foot_m}});
  const auto box = pushable_box(*scene.store.find(scene.wall));
  REQUIRE(box.has_value());
  CHECK(scene.read().box == before.box);
  const RigidTransform stood{before.box->foot_m, about_vertical(before.box->heading_rad)};
  CHECK(glm::distance(pose_by_box(*box, stood, about_vertical(0.4), {}).position_m, Vec3(10.0, 20.0, 1.0)) < 1e-9);
  const RigidTransform turned{Vec3(0.0), about_vertical(0.4 + std::numbers::pi)};
  const RigidTransform pose = pose_by_box(*box, turned, about_vertical(0.4), {});
  CHECK(glm::distance(pose * Vec3(4.0, 0.0, 0.0), turned * Vec3(2.0, -0.5, 0.0)) < 1e-6);
  scene.apply(TagSet{scene.wall, 5, 0, {"solid", false}});
  CHECK_FALSE(pushable_box(*scene.store.find(scene.wall)).has_value());
}

}  // namespace septet::scene
