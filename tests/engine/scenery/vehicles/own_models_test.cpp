#include "engine/scenery/own_models.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/geometry/shapes.hpp"
#include "engine/scene/keyed_part.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scenery/vehicles/vehicles.hpp"

namespace septet::scenery {
namespace {

/// Box of this size about `middle`, and a wheel in front on the left.
gltf::Model box_on_a_wheel(const glm::vec3& size, const glm::vec3& middle) {
  gltf::Model model;
  model.looks = {{.name = "paint"}, {.name = "other"}};
  gltf::Part body{.mesh = geometry::box(middle - 0.5f * size, middle + 0.5f * size)};
  body.mesh.polygon_materials.assign(body.mesh.polygons.size(), 0);
  gltf::Part wheel{.name = "wheel_front_left.001",
                   .origin_m = middle + 0.25f * size,
                   .mesh = geometry::box(glm::vec3(-0.1f), glm::vec3(0.1f))};
  wheel.mesh.polygon_materials.assign(wheel.mesh.polygons.size(), 1);
  model.parts = {std::move(body), std::move(wheel)};
  model.least_m = middle - 0.5f * size;
  model.most_m = middle + 0.5f * size;
  return model;
}

const scene::Prototype& prototype(const scene::ResolvedScene& scene, std::string_view name) {
  const auto found = std::ranges::find_if(scene.prototypes, [&](const scene::Prototype& p) {
    return p.name == name || p.name == "model/" + std::string(name);
  });
  REQUIRE(found != scene.prototypes.end());
  return *found;
}

}  // namespace

TEST_CASE(
    "a person's own saloon is all that is drawn of one, over the middle of its box, with its wheel in its place") {
  scene::Store store;
  scene::SceneBuilder builder(store);
  const OwnModels own{{"saloon", box_on_a_wheel({4.6f, 1.8f, 1.44f}, {7.0f, 3.0f, 0.72f})}};
  build_vehicles(builder, &own);
  const scene::ResolvedScene scene = scene::resolve(store);
  const scene::Prototype& saloon = prototype(scene, "saloon");
  REQUIRE(saloon.parts.size() == 2);
  const VehicleModel& model = vehicle_models()[*find_vehicle_model("saloon")];
  glm::dvec3 least(1e9), most(-1e9);
  for (const scene::Instance& part : saloon.parts) {
    const scene::SurfaceMesh& mesh = scene.meshes[part.mesh];
    least = glm::min(least, part.world_from_object * glm::dvec3(mesh.bounds_min_m));
    most = glm::max(most, part.world_from_object * glm::dvec3(mesh.bounds_max_m));
    CHECK(scene.materials[mesh.parts.front().material].takes_paint == (part.role == scene::PartRole::fixed));
  }
  CHECK(0.5 * (least.x + most.x) == doctest::Approx(model.centre_x_m()));
  CHECK(0.5 * (least.y + most.y) == doctest::Approx(0.0).epsilon(1e-3));
  CHECK(least.z == doctest::Approx(0.0).epsilon(1e-3));
  const auto wheel = std::ranges::find(saloon.parts, scene::PartRole::wheel_front_left, &scene::Instance::role);
  REQUIRE(wheel != saloon.parts.end());
  CHECK(wheel->world_from_object.position_m.x == doctest::Approx(model.centre_x_m() + 0.25 * 4.6));
  CHECK(prototype(scene, "hatchback").parts.size() > 10);
}

TEST_CASE("a model as large as the vehicle is taken without a word, and one a tenth and 5 cm longer with one") {
  const VehicleModel& model = vehicle_models()[*find_vehicle_model("saloon")];
  const auto said = [&](double length_m) {
    const glm::vec3 size(length_m, model.width_m, model.height_m);
    return size_differs(box_on_a_wheel(size, {0.0f, 0.0f, 0.5f * size.z}), model);
  };
  CHECK_FALSE(said(model.length_m).has_value());
  CHECK_FALSE(said(1.1 * model.length_m + 0.04).has_value());
  const auto longer = said(1.1 * model.length_m + 0.06);
  REQUIRE(longer.has_value());
  CHECK(longer->find("4.62") != std::string::npos);
  CHECK(said(0.01 * model.length_m).has_value());
}

TEST_CASE("a part that an animation moves takes its keys into the scene, placed and scaled with the whole") {
  gltf::Model model = box_on_a_wheel(glm::vec3(2.0f), glm::vec3(0.0f));
  model.parts[0].keys = {{0.0f, {0, 0, 1}}, {2.0f, {0, 0, 3}}};
  const OwnModels own{{"lift", std::move(model)}};
  scene::Store store;
  scene::SceneBuilder builder(store);
  const scene::NodeId root = builder.add_object("thing", {.parent_from_object = {{100, 0, 0}}});
  OwnShapes(builder, &own).place("lift", {.parent_from_object = {{10, 0, 0}}, .scale = glm::vec3(2.0f)}, root);
  const scene::ResolvedScene scene = scene::resolve(store);
  REQUIRE(scene.prototypes.size() == 1);
  const auto& parts = scene.prototypes[0].parts;
  const auto moving = std::ranges::find_if(parts, [](const scene::Instance& part) { return part.keyed != nullptr; });
  REQUIRE(moving != parts.end());
  CHECK(std::ranges::count_if(parts, [](const scene::Instance& part) { return part.keyed != nullptr; }) == 1);
  const auto after_a_second = scene::moved(*moving, 1.0);
  REQUIRE(after_a_second.has_value());
  CHECK(after_a_second->world_from_object.position_m == Vec3(10, 0, 4));
  CHECK(after_a_second->scale == glm::vec3(2.0f));
}

TEST_CASE("of the poses of a bent mesh the scene shows one at any time") {
  gltf::Model model = box_on_a_wheel(glm::vec3(2.0f), glm::vec3(0.0f));
  PoseKey there, gone;
  gone.scale = glm::vec3(0.0f);
  model.parts = {model.parts[0], model.parts[0]};
  model.parts[0].keys = {there, there, gone, gone};
  model.parts[1].keys = {gone, gone, there, there};
  for (gltf::Part& part : model.parts) {
    part.keys[1].at_s = part.keys[2].at_s = 1.0f;
    part.keys[3].at_s = 2.0f;
  }
  const OwnModels own{{"flag", std::move(model)}};
  scene::Store store;
  scene::SceneBuilder builder(store);
  OwnShapes(builder, &own).place("flag", {.scale = glm::vec3(2.0f)}, builder.add_object("thing", {}));
  const scene::ResolvedScene scene = scene::resolve(store);
  REQUIRE(scene.prototypes.size() == 1);
  REQUIRE(scene.prototypes[0].parts.size() == 2);
  for (const double time_s : {0.0, 0.99, 1.0, 1.99, 2.5}) {
    CAPTURE(time_s);
    std::vector<bool> shown;
    for (const scene::Instance& part : scene.prototypes[0].parts) {
      const auto moved = scene::moved(part, time_s);
      REQUIRE(moved.has_value());
      shown.push_back(moved->scale == glm::vec3(2.0f));
      CHECK((shown.back() || moved->scale == glm::vec3(0.0f)));
    }
    const bool first = std::fmod(time_s, 2.0) < 1.0;
    CHECK(shown == std::vector<bool>{first, !first});
  }
}

}  // namespace septet::scenery
