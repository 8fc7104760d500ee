#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <doctest/doctest.h>

#include "engine/scene/builder.hpp"
#include "engine/scene/resolve.hpp"

using namespace septet;
using namespace septet::scene;

namespace {

geometry::PolygonMesh triangle() {
  geometry::PolygonMesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.polygons = {{0, 1, 2, geometry::no_vertex}};
  return mesh;
}

struct DrawnWorld {
  Store store;
  SceneBuilder build{store};
  NodeId bitmap = build.add_bitmap("", 1, 1, std::vector<std::uint8_t>(4, 255));
  NodeId mesh = build.add_mesh("", triangle());

  NodeId add_drawn(const MaterialParameters& parameters) {
    const NodeId material = build.add_material("", parameters);
    build.add_object("", {.geometry = mesh, .materials = {material}});
    return material;
  }
};

std::ptrdiff_t instances_drawn(const ResolvedScene& scene) {
  return std::ranges::count_if(scene.instances, [](const Instance& instance) { return instance.mesh != no_mesh; });
}

}  // namespace

TEST_CASE("whatever of a material changes is shown and what does not change it makes nothing anew") {
  const MaterialParameters before{.opacity = 0.5f};
  std::vector<MaterialParameters> changes(18, before);
  changes[0].base_color = {0.1f, 0.8f, 0.8f};
  const DrawnWorld any;
  changes[1].base_color_bitmap = any.bitmap;
  changes[2].roughness = 0.25f;
  changes[3].metallic = 1.0f;
  changes[4].opacity = 0.25f;
  changes[5].refraction_index = 1.33f;
  changes[6].emission = {0, 0, 1};
  changes[7].takes_paint = true;
  changes[8].wettable = true;
  changes[9].share_of_sky = 0.0f;
  changes[10].stripe = true;
  changes[11].retroreflection = 70.0f;
  changes[12].picture_columns = 4;
  changes[13].picture_rows = 8;
  changes[14].in_street = true;
  changes[15].maps[SurfaceMap::emission] = any.bitmap;
  changes[16].maps[SurfaceMap::properties] = any.bitmap;
  changes[17].maps[SurfaceMap::normal] = any.bitmap;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    CAPTURE(i);
    DrawnWorld world, changed;
    const NodeId material = world.add_drawn(before);
    REQUIRE(changed.add_drawn(changes[i]) == material);
    Resolver resolver;
    resolver.update(world.store);
    const std::uint64_t revision = resolver.scene().materials.at(1).revision;
    world.build.apply(NodeNameSet{material, "another name"});
    resolver.update(world.store);
    CHECK(resolver.scene().materials.at(1).revision == revision);
    describe_node(*changed.store.find(material), [&](const Command& command) {
      if (!std::holds_alternative<NodeCreate>(command)) world.build.apply(command);
    });
    resolver.update(world.store);
    CHECK(resolver.scene().materials.at(1).revision > revision);
  }
}

TEST_CASE("a loop of children draws each of them once") {
  DrawnWorld world;
  const NodeId a = world.build.add_object("", {.geometry = world.mesh}),
               b = world.build.add_object("", {.geometry = world.mesh}), root = world.build.add_object("", {});
  world.build.add_child(root, a), world.build.add_child(a, b), world.build.add_child(b, a);
  CHECK(resolve(world.store).instances.size() == 2);
}

TEST_CASE("of a chain of children the first thirty-two are drawn") {
  DrawnWorld world;
  NodeId top = world.build.add_object("", {.geometry = world.mesh});
  for (int i = 1; i < 40; ++i) {
    const NodeId above = world.build.add_object("", {.geometry = world.mesh});
    world.build.add_child(above, top);
    top = above;
  }
  CHECK(resolve(world.store).instances.size() == 32);
}

TEST_CASE("what is placed or scaled out of any world by its parents is not drawn, and no number of it is infinite") {
  for (const bool scaled : {false, true}) {
    CAPTURE(scaled);
    DrawnWorld world;
    NodeId top = world.build.add_object("", {.geometry = world.mesh});
    std::vector<NodeId> chain{top};
    for (int i = 1; i < 30; ++i) {
      const NodeId above = world.build.add_object("", {.geometry = world.mesh});
      world.build.add_child(above, top);
      chain.push_back(top = above);
    }
    for (const NodeId object : chain) {
      Transform transform;
      if (scaled)
        transform.scale = glm::vec3(1e4f);
      else
        transform.position_m.x = 2e8;
      world.build.apply(TransformSet{object, transform});
    }
    const ResolvedScene scene = resolve(world.store);
    // Of scales of 1e4 the product of two is drawn; of 2e8 m each the first alone is within the bound.
    CHECK(scene.instances.size() == (scaled ? 2 : 1));
    for (const Instance& instance : scene.instances) {
      CHECK(std::abs(instance.world_from_object.position_m.x) <= 2.5e8);
      CHECK(instance.scale.x <= 1.01e8f);
    }
  }
}

TEST_CASE("a hidden object hides its children and one that is shown again shows them") {
  DrawnWorld world;
  const NodeId parent = world.build.add_object("", {}), child = world.build.add_object("", {.geometry = world.mesh});
  world.build.add_child(parent, child);
  Resolver resolver;
  resolver.update(world.store);
  CHECK(instances_drawn(resolver.scene()) == 1);
  world.build.apply(HideSet{parent, true});
  resolver.update(world.store);
  CHECK(instances_drawn(resolver.scene()) == 0);
  world.build.apply(HideSet{parent, false});
  resolver.update(world.store);
  CHECK(instances_drawn(resolver.scene()) == 1);
}

TEST_CASE("a parent turns and stretches where its child stands and then the child itself") {
  DrawnWorld world;
  const Quat quarter = orientation_from_angles(1.5707963267948966, 0.0, 0.0);
  const NodeId parent =
      world.build.add_object("", {.parent_from_object = {{0, 0, 0}, quarter}, .scale = {1.0f, 2.0f, 3.0f}});
  const Quat tilt = orientation_from_angles(0.0, 0.5, 0.0);
  const NodeId child = world.build.add_object(
      "", {.parent_from_object = {{1, 1, 1}, tilt}, .scale = {5.0f, 7.0f, 1.0f}, .geometry = world.mesh});
  world.build.add_child(parent, child);
  const Instance placed = resolve(world.store).instances.at(0);
  CHECK(glm::distance(placed.world_from_object.position_m, Vec3(-2, 1, 3)) < 1e-12);
  CHECK(placed.scale == glm::vec3(5.0f, 14.0f, 3.0f));
  const Vec3 ahead = placed.world_from_object.orientation * Vec3(1, 0, 0), expected = quarter * (tilt * Vec3(1, 0, 0));
  CHECK(glm::distance(ahead, expected) < 1e-12);
}

TEST_CASE("an image is made again when its bitmap changes and only then") {
  DrawnWorld world;
  world.add_drawn({.base_color_bitmap = world.bitmap});
  Resolver resolver;
  resolver.update(world.store);
  const std::uint64_t revision = resolver.scene().images.at(0).revision;
  world.build.apply(NodeNameSet{world.mesh, "other"});
  resolver.update(world.store);
  CHECK(resolver.scene().images.at(0).revision == revision);
  std::vector<std::uint8_t> tile(64, 0);
  tile[0] = 9;
  world.build.apply(BitmapTilesSet{world.bitmap, 0, 0, tile});
  resolver.update(world.store);
  CHECK(resolver.scene().images.at(0).revision > revision);
  CHECK(resolver.scene().images.at(0).rgba[0] == 9);
}
