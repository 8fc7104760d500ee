#include <cstdint>
#include <string>
#include <string_view>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/gltf/gltf.hpp"
#include "engine/image/png.hpp"
#include "tests/engine/gltf/file_text.hpp"
#include "tests/why_not.hpp"

namespace septet::gltf {
namespace {

constexpr image::Color red{200, 0, 0, 255}, green{0, 200, 0, 255};

/// A triangle with a picture of a red and a green pixel, and coordinates to `furthest` along u.
Model with_sampler(const char* sampler, float furthest = 1.0f) {
  image::Image picture(2, 1, red);
  picture.set(1, 0, green);
  const Bytes png = image::encode_png(picture);
  const std::string png_bytes(reinterpret_cast<const char*>(png.data()), png.size());
  const File file{.positions = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, furthest, 0, 0, 1}),
                  .primitives = R"([{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}])",
                  .accessors = R"([{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
                               R"({"bufferView":0,"byteOffset":36,"componentType":5126,"count":3,"type":"VEC2"}])",
                  .more = fmt::format(
                      R"("materials":[{{"name":"sign","pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}],)"
                      R"("textures":[{{"source":0,"sampler":0}}],"samplers":[{}],)"
                      R"("images":[{{"uri":"data:image/png;base64,{}"}}],)",
                      sampler, base64(png_bytes))};
  auto model = read_gltf(file.text(), "own.glb", [](std::string_view) { return false; });
  REQUIRE_MESSAGE(model.has_value(), why_not(model));
  return std::move(*model);
}

}  // namespace

TEST_CASE("a picture that repeats mirrored is held with its mirror image, over twice the coordinates") {
  const Model both = with_sampler(R"({"wrapS":33648,"wrapT":33648})", 2.0f);
  const image::Image& picture = both.pictures.at(0);
  REQUIRE(picture.width == 4);
  REQUIRE(picture.height == 2);
  for (const std::uint32_t y : {0u, 1u}) {
    CHECK(picture.at(0, y) == red);
    CHECK(picture.at(1, y) == green);
    CHECK(picture.at(2, y) == green);
    CHECK(picture.at(3, y) == red);
  }
  const auto& uvs = both.parts.at(0).mesh.corner_uvs.at(0);
  CHECK(glm::distance(uvs[1], glm::vec2(1.0f, 0.0f)) < 1e-6f);
  CHECK(glm::distance(uvs[2], glm::vec2(0.0f, 0.5f)) < 1e-6f);
  CHECK(both.left_out.empty());
  const Model one = with_sampler(R"({"wrapS":10497,"wrapT":33648})");
  CHECK(one.pictures.at(0).width == 2);
  CHECK(one.pictures.at(0).height == 2);
}

TEST_CASE("a picture that ends at its edges says so, and its coordinates stay where they are, however far") {
  const Model model = with_sampler(R"({"wrapS":33071})", 300.0f);
  const Picture& picture = model.pictures.at(0);
  CHECK(picture.ends_u);
  CHECK_FALSE(picture.ends_v);
  CHECK(picture.width == 2);
  CHECK(model.parts.at(0).mesh.corner_uvs.at(0)[1] == glm::vec2(300.0f, 0.0f));
  CHECK(model.left_out.empty());
  CHECK_FALSE(with_sampler(R"({"wrapS":10497})", 3.0f).pictures.at(0).ends_u);
  CHECK(with_sampler(R"({"wrapT":33071})").pictures.at(0).ends_v);
}

TEST_CASE("a sampler that asks for sharp pixels gets them, and one that says nothing smooths and repeats") {
  CHECK(with_sampler(R"({"magFilter":9728})").pictures.at(0).is_sharp);
  for (const char* nothing : {"{}", "7", "[]", R"({"wrapS":"MIRRORED","magFilter":-1})"}) {
    const Model model = with_sampler(nothing, 3.0f);
    CHECK_FALSE(model.pictures.at(0).is_sharp);
    CHECK_FALSE(model.pictures[0].ends_u);
    CHECK(model.left_out.empty());
  }
}

}  // namespace septet::gltf
