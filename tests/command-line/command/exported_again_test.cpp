/// What is imported, exported and imported again is drawn as it was, at every instant.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/packing.hpp>

#include "command-line/command/edit/exported_model.hpp"
#include "engine/core/random.hpp"
#include "engine/editor/shapes.hpp"
#include "engine/gltf/write_glb.hpp"
#include "engine/scene/keyed_part.hpp"
#include "engine/scene/resolve.hpp"
#include "tests/checkout.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/why_not.hpp"

namespace septet::server {
namespace {

constexpr scene::NodeId imported = 1000;

scene::Store imported_store(const std::filesystem::path& file) {
  const auto made = editor::make_model("thing", file, {}, imported);
  REQUIRE_MESSAGE(made.has_value(), why_not(made));
  scene::Store store;
  for (const scene::Command& command : made->commands) REQUIRE(store.apply(command).has_value());
  return store;
}

/// What a corner of a triangle shows: place, normal, coordinates, colour, tangent and the material's numbers.
using DrawnCorner = std::array<double, 25>;
using DrawnTriangle = std::array<DrawnCorner, 3>;

/// A number of an image's pixels and of how it is laid; of none −1.
double told_image(const scene::ResolvedScene& scene, std::int32_t index) {
  if (index < 0) return -1.0;
  const scene::TextureImage& image = scene.images.at(static_cast<std::size_t>(index));
  double sum = image.width + 1000.0 * image.height;
  for (std::size_t i = 0; i < image.rgba.size(); ++i) sum += image.rgba[i] * (1.0 + 0.37 * double(i % 97));
  return sum + (image.sampling.clamps_u ? 0.1 : 0.0) + (image.sampling.clamps_v ? 0.2 : 0.0) +
         (image.sampling.sharp ? 0.4 : 0.0);
}

DrawnCorner drawn_corner(const scene::ResolvedScene& scene, const scene::Instance& at, const scene::SurfaceVertex& v,
                         const scene::SurfaceMaterial& m) {
  const Vec3 place = at.world_from_object * Vec3(at.scale * v.position_m);
  const glm::vec3 normal = glm::quat(at.world_from_object.orientation) * v.normal;
  const glm::vec4 tangent = glm::unpackSnorm4x8(v.tangent);
  const glm::vec4 color = glm::unpackUnorm4x8(v.color);
  using scene::SurfaceMap;
  return {place.x,
          place.y,
          place.z,
          normal.x,
          normal.y,
          normal.z,
          v.uv.x,
          v.uv.y,
          m.by_second_uv != 0 ? v.second_uv.x : 0.0,
          m.by_second_uv != 0 ? v.second_uv.y : 0.0,
          color.r * m.base_color.r,
          color.g * m.base_color.g,
          color.b * m.base_color.b,
          tangent.x + 3.0 * tangent.y + 9.0 * tangent.z,
          tangent.w,
          m.roughness + 2.0 * m.metallic,
          m.opacity,
          m.emission.r,
          m.emission.g,
          m.emission.b,
          told_image(scene, m.base_color_image),
          told_image(scene, m.maps[SurfaceMap::emission]) + 3.0 * told_image(scene, m.maps[SurfaceMap::properties]),
          told_image(scene, m.maps[SurfaceMap::normal]),
          double(m.by_second_uv),
          (m.two_sided ? 1.0 : 0.0) + (m.takes_paint ? 2.0 : 0.0)};
}

/// All triangles that are drawn at an instant, in an order of their own. One that moves is drawn about its own origin.
std::vector<DrawnTriangle> drawn_at(const scene::Store& store, double time_s) {
  const scene::ResolvedScene scene = scene::resolve(store);
  std::vector<DrawnTriangle> triangles;
  std::vector<scene::Instance> instances = scene.instances;
  for (const scene::Prototype& prototype : scene.prototypes)
    instances.insert(instances.end(), prototype.parts.begin(), prototype.parts.end());
  for (const scene::Instance& instance : instances) {
    const scene::Instance at = scene::moved(instance, time_s).value_or(instance);
    if (at.scale == glm::vec3(0.0f)) continue;
    const scene::SurfaceMesh& mesh = scene.meshes.at(at.mesh);
    for (const scene::MeshPart& part : mesh.parts)
      for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; i += 3) {
        DrawnTriangle& triangle = triangles.emplace_back();
        for (std::uint32_t k = 0; k < 3; ++k)
          triangle[k] = drawn_corner(scene, at, mesh.vertices[mesh.indices[i + k]], scene.materials.at(part.material));
      }
  }
  return triangles;
}

std::map<std::string, scene::TagValue> extras_of(const scene::Store& store) {
  std::map<std::string, scene::TagValue> extras;
  for (const auto& [group_id, group] : store.find(imported)->tag_groups)
    if (group.name == "extras")
      for (const auto& [tag_id, tag] : group.tags) extras.emplace(tag.name, tag.value);
  return extras;
}

double difference(const DrawnTriangle& a, const DrawnTriangle& b) {
  double most = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < a[k].size(); ++i) most = std::max(most, std::abs(a[k][i] - b[k][i]));
  return most;
}

/// Each triangle has one of its own on the other side.
void check_same(std::vector<DrawnTriangle> a, std::vector<DrawnTriangle> b) {
  REQUIRE(a.size() == b.size());
  for (const DrawnTriangle& triangle : a) {
    const auto nearest =
        std::ranges::min_element(b, {}, [&](const DrawnTriangle& other) { return difference(triangle, other); });
    CHECK(difference(triangle, *nearest) < 2e-4);
    b.erase(nearest);
  }
}

void check_comes_back(const std::filesystem::path& file, const std::filesystem::path& folder) {
  CAPTURE(file);
  const scene::Store store = imported_store(file);
  const auto bytes = exported_model(store, imported, "thing");
  REQUIRE_MESSAGE(bytes.has_value(), why_not(bytes));
  const auto again = folder / "again.glb";
  std::ofstream(again, std::ios::binary).write(reinterpret_cast<const char*>(bytes->data()), std::ssize(*bytes));
  const scene::Store back = imported_store(again);
  CHECK(extras_of(store) == extras_of(back));
  std::size_t drawn = 0;
  for (double time_s = 0.013; time_s < 3.0; time_s += 0.171) {
    CAPTURE(time_s);
    const auto triangles = drawn_at(store, time_s);
    drawn += triangles.size();
    check_same(triangles, drawn_at(back, time_s));
  }
  CHECK(drawn > 0);
}

struct Dice {
  Random random;
  float number(double from, double to) { return static_cast<float>(random.uniform(from, to)); }
  glm::vec3 vector(float size) { return {number(-size, size), number(-size, size), number(-size, size)}; }
  bool flip() { return random.uniform(0.0, 1.0) < 0.5; }
};

/// A thing with every layer of vertices, two materials and motion by lines and jumps; `seed` draws its numbers.
gltf::Drawing drawn_thing(std::uint64_t seed) {
  Dice dice{Random(seed)};
  gltf::Drawing drawing;
  drawing.extras = {
      {"of sheet", true}, {"mass", 12.5}, {"maker", std::string("anybody")}, {"seat", glm::dvec3(1, 2, 3)}};
  for (std::uint8_t i = 0; i < 4; ++i) {
    gltf::Picture picture{image::Image(2, 2, {std::uint8_t(40 * i + 20), 128, std::uint8_t(255 - i), 255})};
    picture.ends_u = dice.flip();
    picture.ends_v = dice.flip();
    drawing.pictures.push_back(picture);
  }
  for (int i = 0; i < 2; ++i) {
    gltf::Look look;
    look.name = i == 0 && dice.flip() ? "paint" : "shell";
    look.base_color = glm::abs(dice.vector(1.0f));
    look.emission = glm::abs(dice.vector(3.0f)) + 0.01f;
    look.roughness = dice.number(0.1, 1.0);
    look.metallic = dice.number(0.0, 1.0);
    look.two_sided = dice.flip();
    look.picture = 0;
    look.emission_picture = 1;
    look.properties_picture = 2;
    look.normal_picture = 3;
    look.by_second_uv = static_cast<std::uint32_t>(dice.random.uniform(0.0, 7.99));
    drawing.looks.push_back(look);
  }
  for (std::uint32_t m = 0; m < 3; ++m) {
    gltf::DrawnMesh mesh;
    for (std::uint32_t i = 0; i < 12; ++i) {
      const glm::vec3 tangent = glm::normalize(dice.vector(1.0f) + glm::vec3(0.0f, 0.0f, 1.5f));
      mesh.vertices.push_back(
          {dice.vector(2.0f) + glm::vec3(10.0f * float(i / 3), 0.0f, 0.0f),
           {0, 0, 1},
           {dice.number(0, 1), dice.number(0, 1)},
           glm::packUnorm4x8(glm::vec4(dice.number(0, 1), dice.number(0, 1), dice.number(0, 1), 1.0f)),
           glm::packSnorm4x8(glm::vec4(tangent, dice.flip() ? 1.0f : -1.0f)),
           {dice.number(0, 1), dice.number(0, 1)}});
      mesh.indices.push_back(i);
    }
    mesh.runs = {{0, 6, 0}, {6, 6, 1}};
    drawing.meshes.push_back(std::move(mesh));
    gltf::DrawnNode node{"thing", m, {}, glm::vec3(1.0f)};
    node.model_from_node.position_m = dice.vector(3.0f);
    // The first stands, the second goes by lines and jumps, the third is there for a part of the time.
    float at_s = 0.0f;
    for (int k = 0; m == 1 && k < 5; ++k) {
      const glm::quat turn = glm::angleAxis(dice.number(-1, 1), glm::normalize(dice.vector(1.0f) + 2.0f));
      node.keys.push_back({at_s, dice.vector(2.0f), turn, glm::vec3(dice.number(0.5, 2.0))});
      if (k != 2) at_s += dice.number(0.1, 0.5);
    }
    const glm::quat upright(1.0f, 0.0f, 0.0f, 0.0f);
    const glm::vec3 gone(0.0f), there(1.0f), origin(0.0f);
    if (m == 2)
      node.keys = {{0.0f, origin, upright, gone},  {0.5f, origin, upright, gone}, {0.5f, origin, upright, there},
                   {0.9f, origin, upright, there}, {0.9f, origin, upright, gone}, {2.1f, origin, upright, gone}};
    drawing.nodes.push_back(std::move(node));
  }
  return drawing;
}

}  // namespace

TEST_CASE("a sample file that is imported, exported and imported again is drawn as it was") {
  const TemporaryFolder folder;
  check_comes_back(source_folder() + "/tests/fuzz/corpus/gltf/textured.glb", folder.path());
}

TEST_CASE("any colours, tangents, second coordinates, materials and motions come back from an export") {
  const TemporaryFolder folder;
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    CAPTURE(seed);
    const auto bytes = gltf::write_glb(drawn_thing(seed), "thing");
    REQUIRE_MESSAGE(bytes.has_value(), why_not(bytes));
    const auto file = folder.path() / "thing.glb";
    std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(bytes->data()), std::ssize(*bytes));
    const auto triangles = drawn_at(imported_store(file), 0.7);
    CHECK(triangles.size() == 12);
    CHECK(std::ranges::any_of(triangles, [](const DrawnTriangle& t) { return t[0][14] != 0.0; }));
    CHECK(std::ranges::any_of(triangles, [](const DrawnTriangle& t) { return t[0][8] != 0.0; }));
    CHECK(extras_of(imported_store(file)).size() == 4);
    check_comes_back(file, folder.path());
  }
}

}  // namespace septet::server
