#include "engine/scene/solid_box.hpp"

#include <numbers>

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

TEST_CASE("what is hidden, or has no shape, has no box, and one in motion is refused") {
  Scene scene;
  scene.apply(HideSet{scene.wall, true});
  CHECK_FALSE(scene.read().box.has_value());
  scene.apply(HideSet{scene.wall, false});
  const ReadSolid before = scene.read();
  CHECK(is_as_read(scene.store, before.read_from));
  scene.apply(NodeDestroy{scene.mesh});
  CHECK_FALSE(is_as_read(scene.store, before.read_from));
  CHECK_FALSE(scene.read().box.has_value());
  MotionSet motion{scene.wall, {}};
  motion.motion.legs.push_back({.velocity_mps = {1.0, 0.0, 0.0}});
  scene.apply(motion);
  const auto moving = read_solid(scene.store, scene.wall);
  REQUIRE_FALSE(moving.has_value());
  CHECK(moving.error().what.find("in motion") != std::string::npos);
}

}  // namespace septet::scene
