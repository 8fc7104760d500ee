#include "engine/scene/keyed_part.hpp"

#include <limits>
#include <utility>
#include <variant>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/geometry/polygon_mesh.hpp"
#include "engine/scene/builder.hpp"
#include "engine/scene/command_limits.hpp"
#include "engine/scene/resolve.hpp"

namespace septet::scene {
namespace {

/// 3 m up in 2 s.
std::vector<PoseKey> lift() { return {{0.0f, {1, 0, 0}}, {2.0f, {1, 0, 3}}}; }

void give_keys(Store& store, NodeId object, const std::vector<PoseKey>& keys) {
  REQUIRE(store.apply(TagGroupSet{object, 0, "draw"}));
  PartId id = 0;
  for (Tag& tag : tags_of_keys(keys)) REQUIRE(store.apply(TagSet{object, 0, id++, std::move(tag)}));
}

/// A root at (10, 0, 0) that doubles lengths, a lifted object below it and a triangle 1 m along y of that one.
struct Lifted {
  Store store;
  NodeId root = no_node, lifted = no_node;

  Lifted() {
    SceneBuilder builder(store);
    geometry::PolygonMesh mesh;
    mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.polygons = {{0, 1, 2, geometry::no_vertex}};
    const NodeId shape = builder.add_mesh("shape", mesh), look = builder.add_material("look", {});
    root = builder.add_object("lift", {.parent_from_object = {{10, 0, 0}}, .scale = glm::vec3(2.0f)});
    lifted = builder.add_object("part", {.parent_from_object = {{1, 0, 0}}});
    builder.add_child(root, lifted);
    builder.add_child(
        lifted,
        builder.add_object("triangle", {.parent_from_object = {{0, 1, 0}}, .geometry = shape, .materials = {look}}));
    give_keys(store, lifted, lift());
  }
};

/// Where the one part of the one moving prototype is drawn.
Vec3 place_at(const ResolvedScene& scene, double time_s) {
  REQUIRE(scene.prototypes.size() == 1);
  REQUIRE(scene.prototypes[0].parts.size() == 1);
  const auto part = moved(scene.prototypes[0].parts[0], time_s);
  REQUIRE(part);
  CHECK(part->scale == glm::vec3(2.0f));
  return pose_at(scene.prototypes[0].motion, time_s).world_from_object * part->world_from_object.position_m;
}

}  // namespace

TEST_CASE("keys beyond any world are none") {
  const float infinite = std::numeric_limits<float>::infinity();
  for (const float wrong : {1e9f, -1e9f, 1e30f, infinite}) {
    CAPTURE(wrong);
    Lifted far, large;
    give_keys(far.store, far.lifted, {{0.0f, {0, wrong, 0}}});
    give_keys(large.store, large.lifted, {{0.0f, {}, {1, 0, 0, 0}, {1, wrong, 1}}});
    CHECK(keys_of(*far.store.find(far.lifted)).empty());
    CHECK(keys_of(*large.store.find(large.lifted)).empty());
  }
}

TEST_CASE("what hangs below an object with keys moves by them, in the frame of that one's parent") {
  const ResolvedScene scene = resolve(Lifted().store);
  CHECK(scene.instances.empty());
  CHECK(glm::distance(place_at(scene, 0.0), Vec3(12, 2, 0)) < 1e-6);
  CHECK(glm::distance(place_at(scene, 1.0), Vec3(12, 2, 3)) < 1e-6);
  CHECK(glm::distance(place_at(scene, 3.0), Vec3(12, 2, 3)) < 1e-6);
}

TEST_CASE("a thing with moving parts that is moved, or that goes by itself, takes them along") {
  Lifted thing;
  Resolver resolver;
  resolver.update(thing.store);
  REQUIRE(thing.store.apply(TransformSet{thing.root, {{20, 0, 0}, Quat(1, 0, 0, 0), glm::vec3(2.0f)}}));
  resolver.update(thing.store);
  CHECK(glm::distance(place_at(resolver.scene(), 1.0), Vec3(22, 2, 3)) < 1e-6);
  REQUIRE(thing.store.apply(MotionSet{thing.root, {{20, 0, 0}, {1, 0, 0, 0}, {{.velocity_mps = {5, 0, 0}}}}}));
  resolver.update(thing.store);
  CHECK(glm::distance(place_at(resolver.scene(), 1.0), Vec3(27, 2, 3)) < 1e-6);
  REQUIRE(thing.store.apply(MotionSet{thing.root, {}}));
  REQUIRE(thing.store.apply(TagGroupDestroy{thing.lifted, 0}));
  resolver.update(thing.store);
  CHECK(resolver.scene().instances.size() == 1);
}

TEST_CASE("keys come out of an object's tags as they went in, also those of several tags") {
  Lifted thing;
  std::vector<PoseKey> many;
  for (int i = 0; i < 500; ++i) many.push_back({0.25f * static_cast<float>(i), glm::vec3(static_cast<float>(i))});
  const auto of_many = tags_of_keys(many);
  CHECK(of_many.size() == 6);
  CHECK(std::get<Blob>(of_many[0].value).size() <= max_tag_blob_bytes);
  give_keys(thing.store, thing.lifted, many);
  CHECK(keys_of(*thing.store.find(thing.lifted)) == many);
  many.resize(2000, many.back());
  CHECK(tags_of_keys(many).size() == 11);
}

TEST_CASE("tags that are no keys move nothing") {
  const auto keys_after = [](TagValue value) {
    Lifted thing;
    REQUIRE(thing.store.apply(TagSet{thing.lifted, 0, 0, {"keys/0", std::move(value)}}));
    return keys_of(*thing.store.find(thing.lifted));
  };
  Blob blob = std::get<Blob>(tags_of_keys(lift()).at(0).value);
  CHECK(keys_after(blob).size() == 2);
  CHECK(keys_after(true).empty());
  CHECK(keys_after(Blob(43)).empty());
  CHECK(keys_after(Blob(44)).empty());  // No rotation.
  Blob falling = std::get<Blob>(tags_of_keys({lift()[1], lift()[0]}).at(0).value);
  CHECK(keys_after(falling).empty());
  blob[6] = blob[7] = 0xFF;  // Not a number.
  CHECK(keys_after(blob).empty());
}

}  // namespace septet::scene
