#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/core/random.hpp"
#include "engine/scene/builder.hpp"
#include "engine/scene/resolve.hpp"
#include "tests/engine/render/studio.hpp"

namespace septet::render {
namespace {

using namespace studio_pictures;
using scene::NodeId;

geometry::PolygonMesh board(double side_m) {
  geometry::PolygonMesh mesh;
  mesh.vertices_m = {{0, side_m, 0}, {0, 0, 0}, {0, 0, side_m}, {0, side_m, side_m}};
  mesh.polygons = {{3, 2, 1, 0}};
  mesh.polygons.push_back({0, 1, 2, 3});
  mesh.corner_uvs.assign(2, {glm::vec2(1, 1), {0, 1}, {0, 0}, {1, 0}});
  return mesh;
}

/// Boards in front of the eye: twelve alone with their mesh, the others of one mesh; some wear an image.
struct Boards {
  scene::Store store;
  scene::SceneBuilder build{store};
  NodeId image = build.add_bitmap("", 44, 36, std::vector<std::uint8_t>(44 * 36 * 4, 255));
  std::vector<NodeId> materials{build.add_material("", {.base_color = {0.8f, 0.1f, 0.1f}}),
                                build.add_material("", {.base_color_bitmap = image})};
  std::vector<NodeId> objects, meshes;

  Boards() {
    const NodeId shared = build.add_mesh("", board(1.0));
    for (int i = 0; i < 30; ++i) {
      const bool alone = i < 12;
      if (alone) meshes.push_back(build.add_mesh("", board(0.6 + 0.05 * i)));
      objects.push_back(build.add_object("", {.parent_from_object = {place(i), {1, 0, 0, 0}},
                                              .geometry = alone ? meshes.back() : shared,
                                              .materials = {materials[static_cast<std::size_t>(i % 2)]}}));
    }
  }
  static Vec3 place(int i) { return {9.0 + 0.37 * i, -6.0 + (i * 7 % 30) * 0.45, 0.2 * (i % 7)}; }

  scene::Command edit(Random& random) {
    const auto number = static_cast<int>(random.below(objects.size()));
    const NodeId object = objects[static_cast<std::size_t>(number)];
    switch (random.below(7)) {
      case 0:
        return scene::HideSet{object, random.below(2) == 0};
      case 1:
        return scene::BitmapTilesSet{image, static_cast<scene::PartId>(random.below(3)),
                                     static_cast<std::uint32_t>(random.below(30)),
                                     std::vector<std::uint8_t>(64, static_cast<std::uint8_t>(random.below(256)))};
      case 2:
        return scene::LinkSet{object, 0, {"geometry", meshes[random.below(meshes.size())], 0}};
      case 3:
        return scene::VerticesSet{meshes[random.below(meshes.size())], 0, {{0.0f, 1.5f, 0.3f}}};
      case 4:
        return scene::LinkSet{object, 1, {"material", materials[random.below(2)], 0}};
      default:
        // Each keeps its distance: of boards in one plane, the order of drawing would decide.
        return scene::TransformSet{object, {{place(number).x, random.uniform(-6, 6), random.uniform(0, 2)}}};
    }
  }
};

struct Screen {
  Renderer renderer{*Renderer::create({width, height, DevicePreference::software, true})};
  FrameInput input;
  Screen() {
    input.environment = reference_day();
    input.views = {forward_view({0, 0, 0}, width, height)};
  }
  ~Screen() {
    CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
  }
  image::Image picture(const scene::ResolvedScene& scene) {
    REQUIRE(renderer.upload(scene).has_value());
    REQUIRE(renderer.draw(input).has_value());
    return *renderer.read_back();
  }
};

}  // namespace

TEST_CASE("a picture after edits is that of the scene uploaded as a whole") {
  Boards boards;
  scene::Resolver resolver;
  resolver.update(boards.store);
  Screen follows;
  image::Image before = follows.picture(resolver.scene());
  Random random(3);
  int changed = 0;
  for (int round = 0; round < 25; ++round) {
    for (int i = 0; i < 4; ++i) REQUIRE(boards.store.apply(boards.edit(random)).has_value());
    resolver.update(boards.store);
    REQUIRE(resolver.scene().changes.since(1).has_value() == false);  // The beginning was read as a whole,
    const image::Image followed = follows.picture(resolver.scene());
    Screen whole;  // … and each picture is compared with one of another renderer that reads all.
    const image::Image expected = whole.picture(scene::resolve(boards.store));
    CAPTURE(round);
    CHECK(mean_difference(followed, expected) < 0.01);
    changed += mean_difference(followed, before) > 0.1;
    before = followed;
  }
  CHECK(changed > 15);
}

}  // namespace septet::render
