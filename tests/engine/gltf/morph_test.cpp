#include <string>
#include <string_view>

#include <doctest/doctest.h>
#include <glm/vec3.hpp>

#include "engine/gltf/gltf.hpp"
#include "tests/engine/gltf/file_text.hpp"
#include "tests/why_not.hpp"

namespace septet::gltf {
namespace {

/// A triangle with a target that moves its vertices by (0, 0, 2), as strong as `weights` of its node say.
File with_target(const std::string& weights) {
  return {.positions = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 2, 0, 0, 2}),
          .nodes = R"([{"mesh":0)" + weights + "}]",
          .primitives = R"([{"attributes":{"POSITION":0},"targets":[{"POSITION":1}]}])",
          .accessors = R"([{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
                       R"({"bufferView":0,"byteOffset":36,"componentType":5126,"count":3,"type":"VEC3"}])"};
}
Expected<Model> read_morphed(const File& file) {
  return read_gltf(file.text(), "own.glb", [](std::string_view) { return false; });
}

}  // namespace

TEST_CASE("a morph target is as strong as the file's weights say") {
  for (const float weight : {0.0f, 0.5f}) {
    const auto model = read_morphed(with_target(weight > 0.0f ? R"(,"weights":[0.5])" : ""));
    REQUIRE_MESSAGE(model.has_value(), why_not(model));
    CHECK(model->parts.at(0).mesh.vertices_m.at(0) == glm::vec3(2.0f * weight, 0.0f, 0.0f));
    CHECK(model->left_out.empty());
  }
}

TEST_CASE("a morph target of other rows than its primitive is refused") {
  File file = with_target(R"(,"weights":[1])");
  file.accessors = R"([{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
                   R"({"bufferView":0,"byteOffset":36,"componentType":5126,"count":2,"type":"VEC3"}])";
  const auto model = read_morphed(file);
  REQUIRE_FALSE(model.has_value());
  CHECK(model.error().what == "POSITION of a morph target has 2 rows, not 3");
}

}  // namespace septet::gltf
