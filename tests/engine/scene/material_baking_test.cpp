#include "engine/scene/material_baking.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <doctest/doctest.h>
#include <glm/common.hpp>

#include "engine/scene/builder.hpp"
#include "engine/scene/fragment_noise.hpp"
#include "engine/scene/material_constants.hpp"
#include "engine/scene/resolve.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::scene;

namespace {

/// Two triangles, each with a material of its own whose tree is a colour by map_u, times a colour.
struct TwoRampedMaterials {
  Store store;
  SceneBuilder builder{store};
  std::array<NodeId, 2> materials{};

  TwoRampedMaterials() {
    geometry::PolygonMesh mesh;
    mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.polygons = {{0, 1, 2, geometry::no_vertex}};
    const NodeId triangle = builder.add_mesh("triangle", mesh);
    for (NodeId& material : materials) {
      material = builder.add_material("ramped", {});
      set(material, 1, GeometryFragment{"map_u", "map_u", "map_u"});
      set(material, 2, ColorFragment{{1.0f, 0.5f, 0.25f}});
      set(material, 3, BlenderFragment{BlendKind::multiply, 1, 2, no_fragment});
      set(material, 1000, OutputFragment{"color", 3, no_fragment});
      // The lowest output counts.
      const auto fragments = std::get<MaterialData>(store.find(material)->data).fragments;
      for (const auto& [id, fragment] : fragments)
        if (id != 1000 && std::holds_alternative<OutputFragment>(fragment))
          builder.apply(FragmentDestroy{material, id});
      ObjectParameters object;
      object.geometry = triangle;
      object.materials = {material};
      builder.add_object("triangle", object);
    }
  }
  void set(NodeId material, FragmentId id, Fragment fragment) {
    builder.apply(FragmentSet{material, id, std::move(fragment)});
  }
};

std::vector<SceneChange::Kind> kinds_since(const ResolvedScene& scene, std::uint64_t revision) {
  std::vector<SceneChange::Kind> kinds;
  const auto changes = scene.changes.since(revision);
  REQUIRE(changes.has_value());
  for (const auto& [at, change] : *changes) kinds.push_back(change.kind);
  return kinds;
}

}  // namespace

TEST_CASE("what varies over a surface is baked once and a changed colour bakes its own material alone") {
  TwoRampedMaterials world;
  Resolver resolver;
  resolver.update(world.store);
  REQUIRE(resolver.scene().images.size() == 2);
  const TextureImage& image = resolver.scene().images[0];
  CHECK(image.width == baked_side);
  CHECK(image.rgba[0] < image.rgba[4 * (baked_side / 2)]);
  CHECK(image.rgba[4 * (baked_side - 1)] == 255);
  const std::uint64_t before = resolver.scene().revision;
  const std::uint64_t other = resolver.scene().images[1].revision;
  // A brighter colour: the picture's shares are the same, and only the number that multiplies them is told.
  world.set(world.materials[0], 2, ColorFragment{{0.5f, 0.5f, 0.25f}});
  resolver.update(world.store);
  CHECK(kinds_since(resolver.scene(), before) == std::vector{SceneChange::Kind::material});
  // Another way of varying: a new picture of this material.
  world.set(world.materials[0], 1, GeometryFragment{"map_v", "map_v", "map_v"});
  resolver.update(world.store);
  CHECK(resolver.scene().images[1].revision == other);
  CHECK(resolver.scene().images[0].revision > before);
  // Without any, its picture is emptied.
  world.set(world.materials[0], 1, ColorFragment{glm::vec3(1.0f)});
  resolver.update(world.store);
  CHECK(resolver.scene().images[0].width == 0);
  CHECK(resolver.scene().images[1].width == baked_side);
}

TEST_CASE("a material is baked anew when a bitmap that it reads has changed") {
  TwoRampedMaterials world;
  const NodeId bitmap = world.builder.add_bitmap("dot", 1, 1, std::vector<std::uint8_t>{100, 100, 100, 255}, false);
  world.set(world.materials[0], 2, TextureFragment{bitmap});
  Resolver resolver;
  resolver.update(world.store);
  const auto brightest = [&] {
    float most = 0.0f;
    for (const SurfaceMaterial& material : resolver.scene().materials) most = std::max(most, material.emission.b);
    return most;
  };
  CHECK(double(brightest()) == relative(100.0 / 255.0, 0.01));
  world.builder.apply(BitmapTilesSet{bitmap, 2, 0, std::vector<std::uint8_t>(64, 200)});
  resolver.update(world.store);
  CHECK(double(brightest()) == relative(200.0 / 255.0, 0.01));
}

TEST_CASE("a tree that numbers and one bitmap say is not baked") {
  Store store;
  SceneBuilder builder(store);
  const NodeId bitmap = builder.add_bitmap("dot", 1, 1, std::vector<std::uint8_t>{100, 100, 100, 255});
  MaterialParameters look;
  look.base_color_bitmap = bitmap;
  look.opacity = 0.5f;
  look.emission = glm::vec3(0.5f);
  CHECK_FALSE(is_to_be_baked(*store.find(builder.add_material("glass", look))));
}

TEST_CASE("noise is 0 at whole numbers, stays within its range and has one value in a cell") {
  float least = 1.0f, most = -1.0f;
  for (int i = 0; i < 4000; ++i) {
    const glm::vec3 place(0.37f * static_cast<float>(i % 20), 0.41f * static_cast<float>(i / 20 % 20),
                          0.53f * static_cast<float>(i / 400));
    const float value = noise_at(NoiseKind::perlin_minus_one_to_one, place);
    least = std::min(least, value), most = std::max(most, value);
    CHECK(noise_at(NoiseKind::perlin_minus_one_to_one, glm::floor(place)) == 0.0f);
    CHECK(noise_at(NoiseKind::point_zero_to_one, place) == noise_at(NoiseKind::point_zero_to_one, glm::floor(place)));
  }
  CHECK(least >= -1.0f);
  CHECK(least < -0.5f);
  CHECK(most <= 1.0f);
  CHECK(most > 0.5f);
}

TEST_CASE("a fragment that is a constant here is named once with what stands for it") {
  Node node;
  MaterialData material;
  material.fragments[3] = ViewFragment{};
  material.fragments[4] = ViewFragment{};
  material.fragments[5] = ColorFragment{};
  material.fragments[6] = LightFragment{};
  material.fragments[7] = ReflectionFragment{0.5f};
  node.data = material;
  CHECK(constant_fragments(node) == std::vector<std::string>{"fragment 3, view: 0.5 in each channel",
                                                             "fragment 7, reflection: normal_falloff is 1"});
}
