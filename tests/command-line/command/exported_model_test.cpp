/// A thing of the scene leaves it as a file, and comes back as it was.

#include "command-line/command/edit/exported_model.hpp"

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/editor/shapes.hpp"
#include "engine/gltf/gltf.hpp"
#include "engine/scene/builder.hpp"
#include "engine/scenery/own_models.hpp"
#include "tests/temporary_folder.hpp"

namespace septet::server {
namespace {

std::string_view text_of(const Bytes& bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

gltf::Model model_of(const Bytes& bytes) {
  auto model = gltf::read_gltf(text_of(bytes), "exported.glb", [](std::string_view) { return false; });
  REQUIRE(model.has_value());
  return std::move(*model);
}

void do_all(scene::Store& store, const std::vector<scene::Command>& commands) {
  for (const scene::Command& command : commands) REQUIRE(store.apply(command).has_value());
}

/// A board with a picture, somewhere, hidden, and a smaller one on top of it.
scene::Store two_boards() {
  scene::Store store;
  do_all(store, editor::make_board("sign", 2.0, 1.0, {{100.0, 200.0, 3.0}, {0.6, 0.0, 0.0, 0.8}, glm::vec3(1.0f)}, 1000)
                    .commands);
  do_all(store, editor::make_picture(store, 1002, image::Image(4, 2, {10, 200, 30, 255}), 1100).commands);
  do_all(store,
         editor::make_board("top", 0.5, 0.5, {{0.0, 0.0, 1.0}, {1.0, 0.0, 0.0, 0.0}, glm::vec3(1.0f)}, 1200).commands);
  do_all(store, {scene::LinkSet{1002, 9, {"child", 1202, 0}}, scene::HideSet{1002, true}});
  return store;
}

}  // namespace

TEST_CASE("an object is exported with what hangs on it, about its own origin, and comes back the same") {
  const scene::Store store = two_boards();
  const auto bytes = exported_model(store, 1002, "sign");
  REQUIRE(bytes.has_value());
  const gltf::Model model = model_of(*bytes);
  CHECK(glm::distance(model.least_m, {0.0f, -1.0f, -0.5f}) < 1e-6f);
  CHECK(glm::distance(model.most_m, {0.0f, 1.0f, 1.25f}) < 1e-6f);
  std::size_t triangles = 0;
  for (const auto& part : model.parts) triangles += part.mesh.polygons.size();
  CHECK(triangles == 4);
  REQUIRE(model.pictures.size() == 1);
  CHECK(model.pictures[0] == image::Image(4, 2, {10, 200, 30, 255}));

  const TemporaryFolder folder;
  const auto file = folder.path() / "sign.glb";
  std::ofstream(file, std::ios::binary) << text_of(*bytes);
  const auto made = editor::make_model("again", file, {}, 5000);
  REQUIRE(made.has_value());
  scene::Store other;
  do_all(other, made->commands);
  const auto again = exported_model(other, 5000, "again");
  REQUIRE(again.has_value());
  const gltf::Model back = model_of(*again);
  CHECK(glm::distance(back.least_m, model.least_m) < 1e-6f);
  CHECK(glm::distance(back.most_m, model.most_m) < 1e-6f);
  CHECK(back.pictures == model.pictures);
}

TEST_CASE("a material's images of emission, properties and normals are exported with it") {
  scene::Store store;
  scene::SceneBuilder build(store);
  geometry::PolygonMesh sheet;
  sheet.vertices_m = {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}};
  sheet.polygons.push_back({0, 1, 2, geometry::no_vertex});
  sheet.corner_uvs.push_back({glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0), glm::vec2(0)});
  scene::MaterialParameters look{.emission = {0.5f, 0.25f, 0.125f}};
  std::uint8_t code = 100;
  for (scene::NodeId& map : look.maps.values) {
    const std::vector<std::uint8_t> pixel{code, 200, 220, 255};
    map = build.add_bitmap("", 1, 1, pixel, code == 100);
    ++code;
  }
  const scene::NodeId object = build.add_object(
      "sheet", {.geometry = build.add_mesh("sheet", sheet), .materials = {build.add_material("", look)}});
  const auto bytes = exported_model(store, object, "sheet");
  REQUIRE(bytes.has_value());
  const gltf::Model model = model_of(*bytes);
  CHECK(model.left_out.empty());
  const gltf::Look& back = model.looks.at(0);
  CHECK(back.emission == glm::vec3(0.5f, 0.25f, 0.125f));
  const auto red_of = [&](std::int32_t picture) { return int(model.pictures.at(std::size_t(picture)).rgba[0]); };
  CHECK(red_of(back.emission_picture) == 100);
  CHECK(red_of(back.properties_picture) == 101);
  CHECK(red_of(back.normal_picture) == 102);
}

TEST_CASE("a wheel of an exported vehicle is a wheel to the reader of models") {
  scene::Store store;
  scene::SceneBuilder build(store);
  geometry::PolygonMesh disc;
  disc.vertices_m = {{-0.3f, 0, -0.3f}, {0.3f, 0, -0.3f}, {0, 0, 0.3f}};
  disc.polygons.push_back({0, 1, 2, geometry::no_vertex});
  const scene::NodeId shape = build.add_mesh("disc", disc), paint = build.add_material("paint", {});
  const scene::NodeId vehicle = build.add_prototype("trolley");
  scene::ObjectParameters wheel{.geometry = shape, .materials = {paint}, .role = scene::PartRole::wheel_front_left};
  wheel.parent_from_object.position_m = {1.2, 0.7, 0.3};
  build.add_child(vehicle, build.add_object("wheel", wheel));
  const auto bytes = exported_model(store, vehicle, "model/trolley");
  REQUIRE(bytes.has_value());
  const auto model = gltf::read_gltf(text_of(*bytes), "trolley.glb", scenery::begins_own_part);
  REQUIRE(model.has_value());
  REQUIRE(model->parts.size() == 1);
  CHECK(model->parts[0].name == "wheel_front_left");
  CHECK(glm::distance(model->parts[0].origin_m, {1.2f, 0.7f, 0.3f}) < 1e-6f);
}

TEST_CASE("what has no shape is exported as a sentence that says so") {
  scene::Store store;
  do_all(store, {scene::NodeCreate{7, scene::NodeType::object}});
  const auto bytes = exported_model(store, 7, "empty");
  REQUIRE_FALSE(bytes.has_value());
  CHECK(describe(bytes.error()).find("empty") != std::string::npos);
}

}  // namespace septet::server
