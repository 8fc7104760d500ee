#include <algorithm>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include <doctest/doctest.h>

#include "engine/core/random.hpp"
#include "engine/scene/builder.hpp"
#include "engine/scene/resolve.hpp"

using namespace septet;
using namespace septet::scene;

namespace {

geometry::PolygonMesh fan(std::uint32_t triangles) {
  geometry::PolygonMesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}};
  for (std::uint32_t i = 0; i < triangles; ++i) {
    mesh.vertices_m.push_back({1.0, 1.0 + i, 0});
    mesh.polygons.push_back({0, i + 1, i + 2, geometry::no_vertex});
  }
  return mesh;
}

/// A world of forty objects, some below others, of six meshes and four materials with two images.
struct EditedWorld {
  Store store;
  SceneBuilder build{store};
  std::vector<NodeId> meshes, materials, bitmaps, objects;
  Random random{7};

  EditedWorld() {
    for (int i = 0; i < 2; ++i)
      bitmaps.push_back(build.add_bitmap("", 20, 12, std::vector<std::uint8_t>(20 * 12 * 4, 255)));
    for (std::uint32_t i = 0; i < 6; ++i) meshes.push_back(build.add_mesh("", fan(i + 1)));
    for (const NodeId bitmap : {bitmaps[0], bitmaps[1], no_node, no_node})
      materials.push_back(bitmap == no_node ? build.add_material("", {})
                                            : build.add_material("", {.base_color_bitmap = bitmap}));
    const NodeId prototype = build.add_prototype("hatchback");
    for (int i = 0; i < 40; ++i) {
      objects.push_back(
          build.add_object("", {.parent_from_object = {{i, 0, 0}, {1, 0, 0, 0}},
                                .geometry = meshes[static_cast<std::size_t>(i) % meshes.size()],
                                .materials = {materials[static_cast<std::size_t>(i) % materials.size()]}}));
      if (i % 5 == 1) build.add_child(objects[static_cast<std::size_t>(i) - 1], objects.back());
      if (i == 7) build.add_child(prototype, objects.back());
    }
  }
  NodeId any(const std::vector<NodeId>& of) { return of[random.below(of.size())]; }

  Command edit() {
    const NodeId object = any(objects);
    switch (random.below(14)) {
      case 12:
        return MotionSet{
            object, {{0, 0, 5}, {1, 0, 0, 0}, {{1.0, {1.0 + static_cast<double>(random.below(3)), 0, 0}, {}, {}}}}};
      case 13:
        return MotionSet{object, {}};
      case 0:
        return HideSet{object, random.below(2) == 0};
      case 1:
        return LinkSet{object, 0, {"geometry", any(meshes), 0}};
      case 2:
        return LinkSet{object, 7, {"child", any(objects), 0}};
      case 3:
        return LinkDestroy{object, 7};
      case 4:
        return NodeDestroy{object};
      case 5:
        return NodeCreate{object, NodeType::object};
      case 6:
        return BitmapTilesSet{any(bitmaps), static_cast<PartId>(random.below(3)),
                              static_cast<std::uint32_t>(random.below(5)), std::vector<std::uint8_t>(64, 9)};
      case 7:
        return FragmentSet{any(materials), 0, ColorFragment{{0.5f, 0.1f, static_cast<float>(random.uniform())}}};
      case 8:
        return VerticesSet{any(meshes), 0, {{0.0f, 0.0f, static_cast<float>(random.uniform())}}};
      case 9:
        return NodeNameSet{object, random.below(4) == 0 ? "model/bus" : "lamp"};
      default:
        return TransformSet{object, {{random.uniform(-9, 9), random.uniform(-9, 9), 0}}};
    }
  }
};

using Drawn = std::tuple<double, double, double, std::size_t, float, float, std::string>;

/// What is drawn, without regard to order and slots.
std::vector<Drawn> drawn(const ResolvedScene& scene) {
  std::vector<Drawn> all;
  const auto add = [&](const Instance& instance, const std::string& of) {
    if (instance.mesh >= scene.meshes.size()) return;
    const SurfaceMesh& mesh = scene.meshes[instance.mesh];
    const Vec3& at = instance.world_from_object.position_m;
    const float blue = mesh.parts.empty() ? -1.0f : scene.materials[mesh.parts.front().material].base_color.b;
    all.emplace_back(at.x, at.y, at.z, mesh.indices.size(), mesh.bounds_max_m.z, blue, of);
  };
  for (const Instance& instance : scene.instances) add(instance, "");
  for (const Prototype& prototype : scene.prototypes)
    for (Instance part : prototype.parts) {
      if (!prototype.motion.legs.empty())
        part.world_from_object = pose_at(prototype.motion, 4.0).world_from_object * part.world_from_object;
      add(part, prototype.name);
    }
  std::ranges::sort(all);
  return all;
}

}  // namespace

TEST_CASE("a scene that followed thousands of edits draws what one resolved anew draws") {
  EditedWorld world;
  Resolver resolver;
  resolver.update(world.store);
  int applied = 0;
  for (int round = 0; round < 400; ++round) {
    for (int i = 0; i < 8; ++i) applied += world.store.apply(world.edit()).has_value();
    resolver.update(world.store);
    const ResolvedScene whole = resolve(world.store);
    REQUIRE(drawn(resolver.scene()) == drawn(whole));
  }
  CHECK(applied > 2000);
}

TEST_CASE("the changes that a scene tells are all that a copy of it needs") {
  EditedWorld world;
  Resolver resolver;
  resolver.update(world.store);
  ResolvedScene copy = resolver.scene();
  int followed = 0;
  for (int round = 0; round < 400; ++round) {
    for (int i = 0; i < 3; ++i) (void)world.store.apply(world.edit());
    resolver.update(world.store);
    const ResolvedScene& scene = resolver.scene();
    const auto changes = scene.changes.since(copy.revision);
    if (!changes) {
      copy = scene;  // Prototypes came or went.
      continue;
    }
    ++followed;
    copy.instances.resize(scene.instances.size());
    copy.meshes.resize(scene.meshes.size());
    copy.materials.resize(scene.materials.size());
    copy.images.resize(scene.images.size());
    copy.prototypes.resize(scene.prototypes.size());
    using Kind = SceneChange::Kind;
    for (const auto& [revision, change] : *changes) {
      const std::uint32_t i = change.index;
      if (change.kind == Kind::instance) copy.instances[i] = scene.instances[i];
      if (change.kind == Kind::mesh) copy.meshes[i] = scene.meshes[i];
      if (change.kind == Kind::material) copy.materials[i] = scene.materials[i];
      if (change.kind == Kind::prototype) copy.prototypes[i] = scene.prototypes[i];
      if (change.kind != Kind::image) continue;
      if (change.pixels.width == 0) {
        copy.images[i] = scene.images[i];
        continue;
      }
      const auto& [x, y, width, height] = change.pixels;
      for (std::uint32_t row = y; row < y + height; ++row)
        for (std::uint32_t at = (row * copy.images[i].width + x) * 4; at < (row * copy.images[i].width + x + width) * 4;
             ++at)
          copy.images[i].rgba[at] = scene.images[i].rgba[at];
    }
    copy.revision = scene.revision;
    REQUIRE(copy.instances == scene.instances);
    REQUIRE(drawn(copy) == drawn(scene));
    for (std::size_t i = 0; i < scene.images.size(); ++i) REQUIRE(copy.images[i].rgba == scene.images[i].rgba);
  }
  CHECK(followed > 100);
}

TEST_CASE("what is not drawn changes nothing of the scene: other tags, names") {
  EditedWorld world;
  Resolver resolver;
  resolver.update(world.store);
  const std::uint64_t revision = resolver.scene().revision;
  for (const NodeId node : {world.objects[3], world.meshes[1], world.materials[0], world.bitmaps[0]})
    for (const Command& command : std::vector<Command>{TagGroupSet{node, 900, "lab"},
                                                       TagSet{node, 900, 0, {"trial", 7u}}, NodeNameSet{node, "x"}})
      REQUIRE(world.store.apply(command).has_value());
  CHECK_FALSE(resolver.update(world.store));
  CHECK(resolver.scene().revision == revision);
}

TEST_CASE("a reader that is far behind is told so and reads everything") {
  ChangeList<int> changes;
  for (int i = 1; i <= 20000; ++i) changes.add(static_cast<std::uint64_t>(i), i);
  CHECK_FALSE(changes.since(0).has_value());
  CHECK_FALSE(changes.since(10000).has_value());
  REQUIRE(changes.since(19990).has_value());
  CHECK(changes.since(19990)->size() == 10);
  CHECK(changes.since(19990)->front().what == 19991);
  changes.add(20001, 20000);  // The same thing again.
  CHECK(changes.since(19999)->size() == 1);
  changes.forget(20001);
  CHECK_FALSE(changes.since(20000).has_value());
  CHECK(changes.since(20001)->empty());
}
