#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "engine/gltf/gltf.hpp"
#include "tests/engine/gltf/file_text.hpp"
#include "tests/why_not.hpp"

namespace septet::gltf {
namespace {

using Sentences = std::vector<std::string>;

Sentences told(const File& file) {
  const auto model = read_gltf(file.text(), "own.glb", [](std::string_view) { return false; });
  REQUIRE_MESSAGE(model.has_value(), why_not(model));
  return model->left_out;
}
Sentences told(const char* more) { return told(File{.more = more}); }

}  // namespace

TEST_CASE("a file of which all is read says nothing") {
  CHECK(told("") == Sentences{});
  CHECK(told(R"("extensionsUsed":["KHR_texture_transform","KHR_mesh_quantization"],"materials":[{}],)") == Sentences{});
}

TEST_CASE("each kind of contents that is passed over is told in one sentence") {
  CHECK(told(R"("extensionsUsed":["KHR_materials_clearcoat","KHR_lights_punctual"],)") ==
        Sentences{"KHR_materials_clearcoat is not done: what it changes is drawn without it",
                  "KHR_lights_punctual is not done: what it changes is drawn without it"});
  CHECK(told(R"("materials":[{},{"name":"door","normalTexture":{}},{"occlusionTexture":{"index":7}}],)") ==
        Sentences{"material \"door\" has a normal texture without an image that is read: it is drawn without it",
                  "material \"material 2\" has an occlusion texture without an image that is read: it is drawn without "
                  "it"});
  CHECK(told(R"("cameras":[{},{},{}],)") == Sentences{"camera 0 (and 2 more) is not read"});
  CHECK(told(File{.primitives = R"([{"attributes":{"POSITION":0},"targets":[{}]},{"attributes":{},"mode":1}])"}) ==
        Sentences{"mesh 0 has points or lines, which are not drawn"});
}

TEST_CASE("of vertices' colours what an unlit material does not show, and alpha, are told with the material") {
  const auto told_of = [](const char* material, float other, float alpha) {
    return told(File{
        .positions = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0.2f, 0, 0, 1, 0.2f, 0, 0, 1, other, 0, 0, alpha}),
        .primitives = R"([{"attributes":{"POSITION":0,"COLOR_0":1},"material":0}])",
        .accessors = R"([{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
                     R"({"bufferView":0,"byteOffset":40,"componentType":5126,"count":3,"type":"VEC4"}])",
        .more = fmt::format(R"("materials":[{{"name":"leaf"{}}}],)", material)});
  };
  const char* unlit = R"(,"extensions":{"KHR_materials_unlit":{}})";
  CHECK(told_of("", 0.9f, 1.0f) == Sentences{});
  CHECK(told_of(unlit, 0.2f, 1.0f) == Sentences{});
  CHECK(told_of(unlit, 0.9f, 1.0f) ==
        Sentences{"unlit material \"leaf\" lies on vertices of several colours, of which the mean is drawn"});
  CHECK(told_of("", 0.9f, 0.5f) ==
        Sentences{"material \"leaf\" lies on vertices with alpha of their own, which is not drawn"});
}

TEST_CASE("of a file that names more extensions than anybody reads the first twenty are told") {
  std::string names = "7";
  for (int i = 0; i < 1000; ++i) names += fmt::format(R"(,"EXT_{}")", i);
  CHECK(told(File{.more = fmt::format(R"("extensionsUsed":[{}],)", names)}).size() == 20);
}

TEST_CASE("a file that requires what is not done is refused by that, though its buffers are empty") {
  const auto model = read_gltf(R"({"asset":{"version":"2.0"},"extensionsRequired":["EXT_meshopt_compression"],)"
                               R"("buffers":[{"byteLength":100}]})",
                               "own.glb", [](std::string_view) { return false; });
  REQUIRE_FALSE(model.has_value());
  CHECK(model.error().what == "it requires EXT_meshopt_compression, which is not done");
}

}  // namespace septet::gltf
