#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/packing.hpp>

#include "engine/gltf/gltf.hpp"
#include "engine/image/png.hpp"
#include "tests/engine/gltf/file_text.hpp"
#include "tests/why_not.hpp"

namespace septet::gltf {
namespace {

/// A triangle with two sets of coordinates, tangents along x with w = `side`, and colours; its node is scaled by
/// `scale`.
File layered(const char* scale, float side, const char* attributes, const char* material) {
  const std::vector<float> numbers{0, 0, 0, 1,    0, 0, 0,    1,    0,              // Positions.
                                   0, 0, 1, 0,    0, 1,                             // Coordinates.
                                   5, 5, 6, 5,    5, 6,                             // The second ones.
                                   1, 0, 0, side, 1, 0, 0,    side, 1, 0, 0, side,  // Tangents.
                                   1, 0, 0, 0,    1, 0, 0.5f, 0,    1};             // Colours.
  const Bytes png = image::encode_png(image::Image(2, 2, {128, 128, 255, 255}));
  const std::string picture(reinterpret_cast<const char*>(png.data()), png.size());
  return {.positions = bytes_of(numbers),
          .nodes = fmt::format(R"([{{"mesh":0,"scale":{}}}])", scale),
          .primitives = fmt::format(
              R"([{{"attributes":{{"POSITION":0,"TEXCOORD_0":1,"TEXCOORD_1":2{}}},"material":0}}])", attributes),
          .accessors = R"([{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
                       R"({"bufferView":0,"byteOffset":36,"componentType":5126,"count":3,"type":"VEC2"},)"
                       R"({"bufferView":0,"byteOffset":60,"componentType":5126,"count":3,"type":"VEC2"},)"
                       R"({"bufferView":0,"byteOffset":84,"componentType":5126,"count":3,"type":"VEC4"},)"
                       R"({"bufferView":0,"byteOffset":132,"componentType":5126,"count":3,"type":"VEC3"}])",
          .more = fmt::format(R"("materials":[{}],"textures":[{{"source":0}}],)"
                              R"("images":[{{"uri":"data:image/png;base64,{}"}}],)",
                              material, base64(picture))};
}
Model layers_of(const File& file) {
  const auto model = read_gltf(file.text(), "own.glb", [](std::string_view) { return false; });
  REQUIRE_MESSAGE(model.has_value(), why_not(model));
  return *model;
}

constexpr const char* with_normals = R"({"normalTexture":{"index":0}})";

}  // namespace

TEST_CASE("each vertex keeps its colour, and the base colour stays as the material has it") {
  const Model model = layers_of(layered("[1,1,1]", 1, R"(,"COLOR_0":4)", "{}"));
  const geometry::PolygonMesh& mesh = model.parts.at(0).mesh;
  REQUIRE(mesh.corner_colors.size() == 1);
  const glm::vec4 last = glm::unpackUnorm4x8(mesh.corner_colors[0][2]);
  CHECK(glm::distance(last, glm::vec4(0.5f, 0, 1, 1)) < 0.003f);
  CHECK(glm::unpackUnorm4x8(mesh.corner_colors[0][0]) == glm::vec4(1, 0, 0, 1));
  CHECK(model.looks.at(mesh.polygon_materials[0]).base_color == glm::vec3(1.0f));
  CHECK(model.left_out.empty());
}

TEST_CASE("a file's tangents arrive along our axes, and a node that mirrors turns their side") {
  for (const float side : {1.0f, -1.0f})
    for (const bool mirrors : {false, true}) {
      CAPTURE(side);
      CAPTURE(mirrors);
      const Model model = layers_of(layered(mirrors ? "[1,1,-1]" : "[1,1,1]", side, R"(,"TANGENT":3)", with_normals));
      const geometry::PolygonMesh& mesh = model.parts.at(0).mesh;
      REQUIRE(mesh.corner_tangents.size() == 1);
      // glTF's x is y here.
      CHECK(glm::unpackSnorm4x8(mesh.corner_tangents[0][0]) == glm::vec4(0, 1, 0, mirrors ? -side : side));
    }
  CHECK(layers_of(layered("[1,1,1]", 1, R"(,"TANGENT":3)", "{}")).parts.at(0).mesh.corner_tangents.empty());
  CHECK(layers_of(layered("[1,1,1]", 1, "", with_normals)).parts.at(0).mesh.corner_tangents.empty());
}

TEST_CASE("a texture by another set of coordinates brings them along") {
  const Model model = layers_of(layered("[1,1,1]", 1, "",
                                        R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},)"
                                        R"("normalTexture":{"index":0,"texCoord":1}})"));
  const geometry::PolygonMesh& mesh = model.parts.at(0).mesh;
  REQUIRE(mesh.second_corner_uvs.size() == 1);
  CHECK(mesh.corner_uvs[0][1] == glm::vec2(1, 0));
  CHECK(mesh.second_corner_uvs[0][1] == glm::vec2(6, 5));
  CHECK(model.looks.at(0).by_second_uv == 4);
  CHECK(model.left_out.empty());
}

}  // namespace septet::gltf
