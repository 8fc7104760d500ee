// Textures of a material beside its base colour's.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "engine/gltf/gltf.hpp"
#include "engine/image/png.hpp"
#include "tests/engine/gltf/file_text.hpp"
#include "tests/relative.hpp"
#include "tests/why_not.hpp"

namespace septet::gltf {
namespace {

using Sentences = std::vector<std::string>;
using image::Color;
using image::Image;

/// A triangle with this material, and textures by these pictures in their order.
Model with_material(const std::string& material, const std::vector<Image>& pictures) {
  std::string textures, images;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const Bytes png = image::encode_png(pictures[i]);
    const char* comma = i > 0 ? "," : "";
    textures += fmt::format(R"({}{{"source":{}}})", comma, i);
    images += fmt::format(R"({}{{"uri":"data:image/png;base64,{}"}})", comma,
                          base64({reinterpret_cast<const char*>(png.data()), png.size()}));
  }
  const File file{
      .positions = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1}),
      .primitives = R"([{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}])",
      .accessors = R"([{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
                   R"({"bufferView":0,"byteOffset":36,"componentType":5126,"count":3,"type":"VEC2"}])",
      .more = fmt::format(R"("materials":[{}],"textures":[{}],"images":[{}],)", material, textures, images)};
  auto model = read_gltf(file.text(), "own.glb", [](std::string_view) { return false; });
  REQUIRE_MESSAGE(model.has_value(), why_not(model));
  return std::move(*model);
}

constexpr Color some{200, 100, 50, 255}, other{10, 60, 240, 255};

}  // namespace

TEST_CASE("a texture of the emission arrives with its factor, and without a factor nothing shines") {
  const Model model = with_material(R"({"emissiveFactor":[1,0.5,0],"emissiveTexture":{"index":0},)"
                                    R"("extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":4}}})",
                                    {Image(2, 2, some)});
  const Look& look = model.looks.at(0);
  CHECK(look.emission == glm::vec3(4, 2, 0));
  CHECK(look.picture == -1);
  REQUIRE(look.emission_picture == 0);
  CHECK(model.pictures.at(0) == Image(2, 2, some));
  CHECK_FALSE(model.pictures[0].is_linear);
  CHECK(model.left_out.empty());
  CHECK(with_material(R"({"emissiveTexture":{"index":0}})", {Image(2, 2, some)}).pictures.empty());
}

TEST_CASE("a picture of the base colour does not colour an emission") {
  const Model model = with_material(
      R"({"emissiveFactor":[1,1,1],"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})", {Image(2, 2, some)});
  const Look& look = model.looks.at(0);
  CHECK(look.emission == glm::vec3(1.0f));
  CHECK(look.emission_picture == -1);
}

TEST_CASE("roughness is green and metallic blue of one texture, and occlusion red of another, as strong as it says") {
  const char* rough = R"("pbrMetallicRoughness":{"metallicRoughnessTexture":{"index":0}})";
  const auto packed = [&](const std::string& material, const std::vector<Image>& pictures) {
    const Model model = with_material("{" + material + "}", pictures);
    CHECK(model.left_out.empty());
    const Look& look = model.looks.at(0);
    CHECK(look.roughness == 1.0f);
    CHECK(look.metallic == 1.0f);
    REQUIRE(look.properties_picture == 0);
    REQUIRE(model.pictures.size() == 1);
    CHECK(model.pictures[0].is_linear);
    return model.pictures[0];
  };
  CHECK(packed(rough, {Image(2, 2, some)}) == Image(2, 2, {255, 100, 50, 255}));
  CHECK(packed(R"("occlusionTexture":{"index":0})", {Image(2, 2, some)}) == Image(2, 2, {200, 255, 255, 255}));
  CHECK(packed(fmt::format(R"({},"occlusionTexture":{{"index":0}})", rough), {Image(2, 2, some)}) ==
        Image(2, 2, {200, 100, 50, 255}));
  // Of the larger size; half as strong: half way from white.
  Image halves(4, 2, other);
  halves.set(3, 1, some);
  Image expected(4, 2, {133, 100, 50, 255});
  expected.set(3, 1, {228, 100, 50, 255});
  CHECK(packed(fmt::format(R"({},"occlusionTexture":{{"index":1,"strength":0.5}})", rough),
               {Image(2, 1, some), halves}) == expected);
}

TEST_CASE("normals of a texture keep their codes, or lean as much more as its scale says") {
  const Image leaning(2, 2, {219, 128, 218, 255});  // 45° along u.
  const auto read = [&](const char* scale) {
    const Model model = with_material(fmt::format(R"({{"normalTexture":{{"index":0{}}}}})", scale), {leaning});
    REQUIRE(model.looks.at(0).normal_picture == 0);
    CHECK(model.pictures.at(0).is_linear);
    CHECK(model.left_out.empty());
    return model.pictures[0];
  };
  CHECK(read("") == leaning);
  // atan ½ = 26.6°: (1 + sin) / 2 and (1 + cos) / 2.
  const Color half = read(R"(,"scale":0.5)").at(0, 0);
  CHECK(int(half.red) == relative(184.5, 0.01));
  CHECK(int(half.blue) == relative(241.5, 0.01));
  CHECK(int(read(R"(,"scale":-1)").at(0, 0).red) == relative(36.0, 0.05));
}

TEST_CASE("a material's textures lie in two ways, and one that lies in a third is told and not drawn") {
  const Model model = with_material(
      R"({"name":"door","pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"emissiveFactor":[1,1,1],)"
      R"("normalTexture":{"index":0},"occlusionTexture":{"index":0,"texCoord":1},"emissiveTexture":{"index":0,)"
      R"("extensions":{"KHR_texture_transform":{"texCoord":1}}}})",
      {Image(2, 2, some)});
  CHECK(model.left_out ==
        Sentences{"material \"door\" lays its picture by TEXCOORD_1, which mesh 0 does not have: one colour of the "
                  "picture is seen there"});
  const Look& look = model.looks.at(0);
  CHECK(look.mapping.uv_set == 0);
  CHECK(look.second_mapping.uv_set == 1);
  CHECK(look.by_second_uv == 3);  // Emission and properties.
  CHECK(look.properties_picture >= 0);

  const Model third = with_material(
      R"({"name":"door","pbrMetallicRoughness":{"baseColorTexture":{"index":0},)"
      R"("metallicRoughnessTexture":{"index":0}},"occlusionTexture":{"index":0,"texCoord":1},)"
      R"("emissiveFactor":[1,1,1],"emissiveTexture":{"index":0,"texCoord":2},"normalTexture":{"index":0,"texCoord":3}})",
      {Image(2, 2, some)});
  REQUIRE(third.left_out.size() >= 2);
  CHECK(third.left_out[0] ==
        "material \"door\" lays its occlusion texture otherwise than its metallic-roughness one, which is not done: it "
        "is drawn without it");
  CHECK(third.left_out[1] ==
        "material \"door\" lays its normal texture in a third way, which is not done: it is drawn without it");
  CHECK(third.looks.at(0).normal_picture == -1);
  CHECK(third.looks.at(0).by_second_uv == 1);
}

TEST_CASE("an unlit material shines with its base colour, which no light changes") {
  const Model model = with_material(R"({"pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0.25,1],)"
                                    R"("baseColorTexture":{"index":0}},"emissiveFactor":[1,1,1],)"
                                    R"("normalTexture":{"index":0},"extensions":{"KHR_materials_unlit":{}}})",
                                    {Image(2, 2, some)});
  const Look& look = model.looks.at(0);
  CHECK(look.base_color == glm::vec3(0.0f));
  CHECK(look.emission == glm::vec3(1.0f, 0.5f, 0.25f));
  REQUIRE(look.emission_picture >= 0);
  CHECK(model.pictures.at(static_cast<std::size_t>(look.emission_picture)) == Image(2, 2, some));
  CHECK(look.normal_picture == -1);
  CHECK(look.metallic == 0.0f);
  CHECK(look.roughness == 1.0f);
}

TEST_CASE("a picture's alpha blends where the material asks for it and more than soft edges are half there") {
  Image half(8, 8, {200, 100, 50, 128}), edges(8, 8, {200, 100, 50, 255});
  for (std::uint32_t x = 0; x < 8; ++x) edges.set(x, 0, {200, 100, 50, 0});
  edges.set(0, 1, {200, 100, 50, 128});
  const auto look_of = [](const char* mode, const Image& picture) {
    const Model model = with_material(
        fmt::format(R"({{"alphaMode":"{}","pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}})", mode),
        {picture});
    CHECK(model.pictures.at(0).at(0, 0).alpha == (std::string_view(mode) == "OPAQUE" ? 255 : picture.at(0, 0).alpha));
    return model.looks.at(0);
  };
  CHECK(look_of("BLEND", half).alpha_blends);
  CHECK(look_of("BLEND", half).opacity == 1.0f);
  CHECK_FALSE(look_of("BLEND", edges).alpha_blends);
  CHECK_FALSE(look_of("MASK", half).alpha_blends);
  CHECK_FALSE(look_of("OPAQUE", half).alpha_blends);
}

TEST_CASE("what is below a material's own cutoff is cut out, and nothing else") {
  Image ramp(256, 1, some);
  for (std::uint32_t x = 0; x < 256; ++x) ramp.set(x, 0, {200, 100, 50, static_cast<std::uint8_t>(x)});
  struct Cutoff {
    double cutoff, factor;
  };
  for (const Cutoff& of :
       {Cutoff{0.5, 1.0}, {0.25, 1.0}, {0.75, 1.0}, {0.0, 1.0}, {1.0, 1.0}, {0.3, 0.5}, {0.6, 0.5}}) {
    CAPTURE(of.cutoff);
    const Model model =
        with_material(fmt::format(R"({{"alphaMode":"MASK","alphaCutoff":{},"pbrMetallicRoughness":)"
                                  R"({{"baseColorFactor":[1,1,1,{}],"baseColorTexture":{{"index":0}}}}}})",
                                  of.cutoff, of.factor),
                      {ramp});
    for (std::uint32_t x = 0; x < 256; ++x) {
      const bool is_there = x / 255.0 * of.factor >= of.cutoff;
      CHECK((model.pictures.at(0).at(x, 0).alpha >= 128) == is_there);
    }
  }
}

TEST_CASE("a texture of what lets light through is told as the constant that it becomes") {
  const Model model = with_material(R"({"name":"bottle","extensions":{"KHR_materials_transmission":)"
                                    R"({"transmissionFactor":0.5,"transmissionTexture":{"index":0}}}})",
                                    {Image(2, 2, some)});
  CHECK(model.left_out == Sentences{"material \"bottle\" lets light through as a texture says, which is a constant "
                                    "here: its factor"});
}

}  // namespace septet::gltf
