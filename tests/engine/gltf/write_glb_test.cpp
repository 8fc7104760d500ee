/// What is written is what is read.

#include "engine/gltf/write_glb.hpp"

#include <string_view>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

using namespace septet;
using namespace septet::gltf;

namespace {

/// Two triangles of a square in the y-z plane that is seen from +x, one of each look.
DrawnMesh square() {
  const glm::vec3 ahead(1, 0, 0);
  return {{{{0, -1, 0}, ahead, {0, 1}},
           {{0, 1, 0}, ahead, {1, 1}},
           {{0, 1, 2}, ahead, {1, 0}},
           {{0, -1, 2}, ahead, {0, 0}}},
          {0, 1, 2, 0, 2, 3},
          {{0, 3, 0}, {3, 3, 1}}};
}

Model model_of(const Bytes& bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  auto model = read_gltf(text, "written.glb", [](std::string_view) { return false; });
  REQUIRE(model.has_value());
  CHECK(model->left_out.empty());
  return std::move(*model);
}

}  // namespace

TEST_CASE("a drawing that is written is read again with its shape, its place, its looks and its pictures") {
  Look painted;
  painted.name = "painted \"red\"";
  painted.base_color = {0.5f, 0.25f, 0.125f};
  painted.picture = 0;
  painted.roughness = 0.25f;
  painted.metallic = 0.75f;
  painted.two_sided = true;
  Look lamp;
  lamp.name = "lamp";
  lamp.emission = {8.0f, 4.0f, 2.0f};
  lamp.opacity = 0.5f;
  Drawing drawing{{square()}, {}, {painted, lamp}, {Picture{image::Image(2, 1, {10, 20, 30, 255})}}};
  drawing.pictures[0].set(1, 0, {200, 100, 50, 0});
  DrawnNode node{"sign", 0, {}, {1.0f, 2.0f, 3.0f}};
  node.model_from_node.position_m = {5.0, 6.0, 7.0};
  node.model_from_node.orientation = glm::angleAxis(glm::half_pi<double>(), Vec3(0, 0, 1));  // Its x axis along y.
  drawing.nodes.push_back(node);

  const auto bytes = write_glb(drawing, "sign");
  REQUIRE(bytes.has_value());
  const Model model = model_of(*bytes);
  REQUIRE(model.parts.size() == 1);
  CHECK(model.parts[0].mesh.polygons.size() == 2);
  CHECK(glm::distance(model.least_m, {3.0f, 6.0f, 7.0f}) < 1e-5f);  // Twice as wide, along −x; three times as high.
  CHECK(glm::distance(model.most_m, {7.0f, 6.0f, 13.0f}) < 1e-5f);
  const auto& mesh = model.parts[0].mesh;
  const auto corner = [&](std::size_t k) { return mesh.vertices_m[mesh.polygons[0][k]]; };
  CHECK(glm::cross(corner(1) - corner(0), corner(2) - corner(0)).y > 0.0f);  // It is seen from +y.
  REQUIRE(model.looks.size() >= 2);
  CHECK(model.looks[0].name == painted.name);
  CHECK(model.looks[0].base_color == painted.base_color);
  CHECK(model.looks[0].roughness == painted.roughness);
  CHECK(model.looks[0].metallic == painted.metallic);
  CHECK(model.looks[0].two_sided);
  REQUIRE(model.looks[0].picture == 0);
  CHECK(model.pictures[0] == drawing.pictures[0]);
  CHECK(model.looks[1].opacity == lamp.opacity);
  CHECK(glm::distance(model.looks[1].emission, lamp.emission) < 1e-5f);
  CHECK(mesh.polygon_materials == std::vector<std::uint32_t>{0, 1});
}

TEST_CASE("a drawing of nothing is no file") {
  const auto bytes = write_glb({}, "nobody");
  REQUIRE_FALSE(bytes.has_value());
  CHECK(describe(bytes.error()).find("nobody") != std::string::npos);
}
