#include "engine/gltf/gltf.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include "engine/image/jpeg.hpp"
#include "engine/image/png.hpp"
#include "tests/engine/gltf/file_text.hpp"
#include "tests/why_not.hpp"

namespace septet::gltf {
namespace {

Expected<Model> read(const std::string& bytes) {
  return read_gltf(bytes, "own.glb", [](std::string_view name) { return name.starts_with("wheel"); });
}
Expected<Model> read(const File& file) { return read(file.text()); }

/// The error's text, or empty.
std::string refused(const std::string& bytes) {
  const auto model = read(bytes);
  if (model) return "";
  CHECK(model.error().where.starts_with("own.glb"));
  CHECK_FALSE(model.error().remedy.empty());
  return model.error().what;
}
std::string refused(const File& file) { return refused(file.text()); }

bool has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

std::string glb(const std::string& json, const std::string& binary) {
  const auto word = [](std::uint32_t value) { return bytes_of<std::uint32_t>({value}); };
  const auto size = [](const std::string& text) { return static_cast<std::uint32_t>(text.size()); };
  const std::string chunks =
      word(size(json)) + word(0x4E4F534A) + json + word(size(binary)) + word(0x004E4942) + binary;
  return "glTF" + word(2) + word(12 + size(chunks)) + chunks;
}

}  // namespace

TEST_CASE("glTF's left, up and forward are y, z and x here, and its front faces stay fronts") {
  const auto model = read(File{.positions = bytes_of<float>({2, 3, 4, 3, 3, 4, 2, 4, 4})});
  REQUIRE(model.has_value());
  REQUIRE(model->parts.size() == 1);
  const geometry::PolygonMesh& mesh = model->parts[0].mesh;
  REQUIRE(mesh.polygons.size() == 1);
  const auto at = [&](std::size_t k) { return mesh.vertices_m[mesh.polygons[0][k]]; };
  CHECK(at(0) == glm::vec3(4, 2, 3));
  CHECK(at(1) == glm::vec3(4, 3, 3));
  CHECK(at(2) == glm::vec3(4, 2, 4));
  CHECK(model->least_m == glm::vec3(4, 2, 3));
  CHECK(model->most_m == glm::vec3(4, 3, 4));
}

TEST_CASE("a node that mirrors turns its triangles round") {
  const auto model = read(File{.nodes = R"([{"mesh":0,"scale":[-1,1,1]}])"});
  REQUIRE(model.has_value());
  const geometry::PolygonMesh& mesh = model->parts[0].mesh;
  const auto at = [&](std::size_t k) { return mesh.vertices_m[mesh.polygons[0][k]]; };
  CHECK(glm::cross(at(1) - at(0), at(2) - at(0)).x > 0.0f);  // glTF's +z, as before the mirror.
}

TEST_CASE("what hangs below a wheel's node is a part about the wheel's centre") {
  const auto model = read(File{
      .nodes = R"([{"mesh":0,"children":[1]},{"name":"wheel_left","translation":[1,2,3],"children":[2]},{"mesh":0}])"});
  REQUIRE(model.has_value());
  REQUIRE(model->parts.size() == 2);
  CHECK(model->parts[1].name == "wheel_left");
  CHECK(model->parts[1].origin_m == glm::vec3(3, 1, 2));
  CHECK(model->parts[1].mesh.vertices_m.front() == glm::vec3(0));
  CHECK(model->most_m == glm::vec3(3, 2, 3));
}

TEST_CASE("vertices are joined where place and normal agree, and nowhere else") {
  // Two triangles of a square that share two places; the second has other normals.
  const std::vector<float> places{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  for (const float other : {1.0f, -1.0f}) {
    std::vector<float> rows = places;
    for (int i = 0; i < 6; ++i) rows.insert(rows.end(), {0, 0, i < 3 ? 1.0f : other});
    const auto model =
        read(File{.positions = bytes_of(rows),
                  .primitives = R"([{"attributes":{"POSITION":0,"NORMAL":1}}])",
                  .accessors = R"([{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3"},)"
                               R"({"bufferView":0,"byteOffset":72,"componentType":5126,"count":6,"type":"VEC3"}])"});
    REQUIRE(model.has_value());
    CHECK(model->parts[0].mesh.polygons.size() == 2);
    CHECK(model->parts[0].mesh.vertices_m.size() == (other > 0.0f ? 4 : 6));
  }
}

TEST_CASE("strips and fans turn the way that glTF says") {
  const std::vector<float> square{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  for (const int mode : {5, 6}) {
    const auto model = read(File{.positions = bytes_of(square),
                                 .primitives = fmt::format(R"([{{"attributes":{{"POSITION":0}},"mode":{}}}])", mode),
                                 .accessors = R"([{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}])"});
    REQUIRE(model.has_value());
    const geometry::PolygonMesh& mesh = model->parts[0].mesh;
    REQUIRE(mesh.polygons.size() == 2);
    const auto turn = [&](std::size_t i) {
      const auto at = [&](std::size_t k) { return mesh.vertices_m[mesh.polygons[i][k]]; };
      return glm::cross(at(1) - at(0), at(2) - at(0)).x;
    };
    CHECK(turn(0) == doctest::Approx(1.0));
    CHECK(turn(1) == doctest::Approx(mode == 5 ? 1.0 : -1.0));
  }
}

TEST_CASE("a material's factors, its picture and the one colour of all vertices arrive") {
  image::Image picture(4, 2, {10, 20, 30, 40});
  const Bytes png = image::encode_png(picture);
  const std::string png_bytes(reinterpret_cast<const char*>(png.data()), png.size());
  const auto model = read(File{
      .positions = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0.5f, 0.5f, 0, 0.5f, 0.5f, 0, 0.5f, 0.5f, 0}),
      .primitives = R"([{"attributes":{"POSITION":0,"COLOR_0":1},"material":0}])",
      .accessors = R"([{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
                   R"({"bufferView":0,"byteOffset":36,"componentType":5126,"count":3,"type":"VEC3"}])",
      .more = fmt::format(
          R"("materials":[{{"name":"glass","alphaMode":"BLEND","emissiveFactor":[0.5,0,0],)"
          R"("extensions":{{"KHR_materials_emissive_strength":{{"emissiveStrength":4}}}},)"
          R"("pbrMetallicRoughness":{{"baseColorFactor":[1,1,0.5,0.25],"metallicFactor":0.2,"roughnessFactor":0.4,"baseColorTexture":{{"index":0}}}}}}],)"
          R"("textures":[{{"source":0}}],"images":[{{"uri":"data:image/png;base64,{}"}}],)",
          base64(png_bytes))});
  REQUIRE(model.has_value());
  const Look& look = model->looks[model->parts[0].mesh.polygon_materials[0]];
  CHECK(look.name == "glass");
  CHECK(look.opacity == doctest::Approx(0.25));
  CHECK(look.metallic == doctest::Approx(0.2));
  CHECK(look.roughness == doctest::Approx(0.4));
  CHECK(look.emission.r == doctest::Approx(2.0));
  CHECK(look.base_color.r == doctest::Approx(0.5));
  CHECK(look.base_color.g == doctest::Approx(0.5));
  CHECK(look.base_color.b == doctest::Approx(0.0));
  REQUIRE(look.picture == 0);
  CHECK(model->pictures[0].width == 4);
  CHECK(model->pictures[0].at(3, 1) == image::Color{10, 20, 30, 40});
}

TEST_CASE("a material's picture may be a JPEG, and one that is cut off is refused with its image") {
  const Bytes jpeg = image::encode_jpeg(image::Image(40, 24, {10, 120, 200, 255}), 95);
  const auto with = [](std::string_view bytes) {
    return File{.primitives = R"([{"attributes":{"POSITION":0},"material":0}])",
                .more = fmt::format(R"("materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}],)"
                                    R"("textures":[{{"source":0}}],"images":[{{"uri":"data:;base64,{}"}}],)",
                                    base64(bytes))};
  };
  const std::string_view bytes(reinterpret_cast<const char*>(jpeg.data()), jpeg.size());
  const auto model = read(with(bytes));
  REQUIRE_MESSAGE(model.has_value(), why_not(model));
  REQUIRE(model->looks.at(0).picture == 0);
  CHECK(model->pictures[0].width == 40);
  CHECK(model->pictures[0].height == 24);
  const image::Color color = model->pictures[0].at(39, 23);
  CHECK(std::abs(color.red - 10) < 4);
  CHECK(std::abs(color.green - 120) < 4);
  CHECK(std::abs(color.blue - 200) < 4);
  CHECK(color.alpha == 255);
  const auto cut = read(with(bytes.substr(0, bytes.size() - 8)));
  REQUIRE_FALSE(cut.has_value());
  CHECK(cut.error().what == "its JPEG is cut off or damaged");
  CHECK(cut.error().where == "own.glb, image 0");
  const auto other = read(with("GIF89a and what follows it"));
  REQUIRE(other.has_value());
  CHECK(other->left_out ==
        std::vector<std::string>{"image 0 is neither PNG nor JPEG: material \"material 0\" has its plain colour"});
}

TEST_CASE("a texture lies by the coordinates that it names, scaled, turned and moved") {
  const Bytes png = image::encode_png(image::Image(1, 1, {10, 20, 30, 255}));
  const std::string png_bytes(reinterpret_cast<const char*>(png.data()), png.size());
  // Rows of two numbers for three vertices: set 0 from byte 36, set 1 from byte 60.
  const auto uvs = [&](const std::string& texture) {
    const auto model = read(
        File{.positions = bytes_of<float>(
                 {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.25f, 0, 0.75f, 0, 0.25f, 1, 0.5f, 0.1f, 0.6f, 0.1f, 0.5f, 0.2f}),
             .primitives = R"([{"attributes":{"POSITION":0,"TEXCOORD_0":1,"TEXCOORD_1":2},"material":0}])",
             .accessors = R"([{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
                          R"({"bufferView":0,"byteOffset":36,"componentType":5126,"count":3,"type":"VEC2"},)"
                          R"({"bufferView":0,"byteOffset":60,"componentType":5126,"count":3,"type":"VEC2"}])",
             .more = fmt::format(R"("extensionsRequired":["KHR_texture_transform"],)"
                                 R"("materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0{}}}}}}}],)"
                                 R"("textures":[{{"source":0}}],"images":[{{"uri":"data:image/png;base64,{}"}}],)",
                                 texture, base64(png_bytes))});
    REQUIRE_MESSAGE(model.has_value(), why_not(model));
    REQUIRE(model->parts[0].mesh.corner_uvs.size() == 1);
    return model->parts[0].mesh.corner_uvs[0];
  };
  const auto is_near = [](const glm::vec2& uv, float u, float v) { return glm::distance(uv, glm::vec2(u, v)) < 1e-6f; };
  const auto transformed = [](const char* transform) {
    return fmt::format(R"(,"extensions":{{"KHR_texture_transform":{{{}}}}})", transform);
  };
  CHECK(is_near(uvs("")[0], 0.25f, 0.0f));
  CHECK(is_near(uvs(R"(,"texCoord":1)")[0], 0.5f, 0.1f));
  CHECK(is_near(uvs(transformed(R"("offset":[0.5,0.25])"))[0], 0.75f, 0.25f));
  CHECK(is_near(uvs(transformed(R"("scale":[2,3])"))[1], 1.5f, 0.0f));
  // A quarter turn counter-clockwise, v pointing down: the right lies above.
  CHECK(is_near(uvs(transformed(R"("rotation":1.5707963267948966)"))[1], 0.0f, -0.75f));
  CHECK(is_near(uvs(transformed(R"("scale":[2,1],"rotation":1.5707963267948966,"offset":[0.1,1])"))[1], 0.1f, -0.5f));
  CHECK(is_near(uvs(transformed(R"("texCoord":1,"offset":[0.5,0])"))[1], 1.1f, 0.1f));
  CHECK(is_near(uvs(transformed(R"("offset":"left","scale":[1],"rotation":null)"))[0], 0.25f, 0.0f));
  // Far away the whole triangle is moved by whole pictures.
  const auto far = uvs(transformed(R"("offset":[1000,-1000])"));
  CHECK(is_near(far[1] - far[0], 0.5f, 0.0f));
  CHECK(std::abs(far[0].x) < 64.0f);
}

TEST_CASE("a picture whose texture coordinates a mesh does not have is told once a material with its meshes") {
  const Bytes png = image::encode_png(image::Image(1, 1, {10, 20, 30, 255}));
  const std::string png_bytes(reinterpret_cast<const char*>(png.data()), png.size());
  const auto left_out = [&](const char* texture, const char* nodes, const char* scene_nodes) {
    std::string text =
        File{.positions = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0.25f, 0, 0.75f, 0, 0.25f, 1}),
             .nodes = nodes,
             .scene_nodes = scene_nodes,
             .primitives = R"([{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]},)"
                           R"({"name":"wheel\nhub","primitives":[{"attributes":{"POSITION":0},"material":0},)"
                           R"({"attributes":{"POSITION":0},"material":0}]},)"
                           R"({"primitives":[{"attributes":{"POSITION":0},"material":1}])",
             .accessors = R"([{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
                          R"({"bufferView":0,"byteOffset":36,"componentType":5126,"count":3,"type":"VEC2"}])",
             .more = fmt::format(
                 R"("materials":[{{"name":"paint","pbrMetallicRoughness":{{"baseColorTexture":{{"index":0{}}}}}}},)"
                 R"({{"name":"plain one"}}],)"
                 R"("textures":[{{"source":0}}],"images":[{{"uri":"data:image/png;base64,{}"}}],)",
                 texture, base64(png_bytes))}
            .text();
    const auto model = read(text);
    REQUIRE_MESSAGE(model.has_value(), why_not(model));
    return model->left_out;
  };
  using Sentences = std::vector<std::string>;
  constexpr const char* all = R"([{"mesh":0},{"mesh":1},{"mesh":2}])";
  CHECK(left_out("", all, "[0,2]") == Sentences{});
  CHECK(left_out("", all, "[0,1,2]") ==
        Sentences{
            "material \"paint\" lays its picture by TEXCOORD_0, which mesh \"wheel\\x0ahub\" does not have: one colour "
            "of the picture is seen there"});
  CHECK(
      left_out(R"(,"texCoord":3)", all, "[1,0,2]") ==
      Sentences{"material \"paint\" lays its picture by TEXCOORD_3, which mesh 0, one of 2 such meshes, does not have: "
                "one colour of the picture is seen there"});
}

TEST_CASE("what is required and not done is refused by its name") {
  for (const char* extension : {"KHR_materials_pbrSpecularGlossiness", "KHR_materials_clearcoat", "KHR_node_visibility",
                                "EXT_meshopt_compression"}) {
    CHECK(has(refused(File{.more = fmt::format(R"("extensionsRequired":["{}"],)", extension)}), extension));
    CHECK(read(File{.more = fmt::format(R"("extensionsUsed":["{}"],)", extension)}).has_value());
  }
}

TEST_CASE("rows that a sparse accessor names are written over the others, or over zeros") {
  const auto with = [](const char* accessor) {
    // Three places, then the indices 0, 2 as u16, a pad, and their places.
    std::string bytes = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});
    bytes += bytes_of<std::uint16_t>({0, 2});
    bytes += bytes_of<float>({0, 0, 5, 0, 1, 5});
    return File{.positions = bytes,
                .accessors = accessor,
                .views = R"([{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":4},)"
                         R"({"buffer":0,"byteOffset":40,"byteLength":24}])"};
  };
  const auto places = [](const File& file) {
    const auto model = read(file);
    REQUIRE_MESSAGE(model.has_value(), why_not(model));
    return model->parts.at(0).mesh.vertices_m;
  };
#define SPARSE(count, indices, values) \
  R"("sparse":{"count":)" count R"(,"indices":{)" indices R"(},"values":{)" values "}}"
  constexpr const char* over = R"([{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",)" SPARSE(
      "2", R"("bufferView":1,"componentType":5123)", R"("bufferView":2)") "}]";
  const auto written = places(with(over));
  REQUIRE(written.size() == 3);
  CHECK(written[0] == glm::vec3(5, 0, 0));
  CHECK(written[1] == glm::vec3(0, 1, 0));
  CHECK(written[2] == glm::vec3(5, 0, 1));
  constexpr const char* over_zeros = R"([{"componentType":5126,"count":3,"type":"VEC3",)" SPARSE(
      "2", R"("bufferView":1,"componentType":5123)", R"("bufferView":2)") "}]";
  CHECK(places(with(over_zeros))[1] == glm::vec3(0, 0, 0));
  const std::pair<const char*, const char*> wrong[] = {
      {SPARSE("4", R"("bufferView":1,"componentType":5123)", R"("bufferView":2)"), "counts 4 of 3"},
      {SPARSE("0", R"("bufferView":1,"componentType":5123)", R"("bufferView":2)"), "counts 0 of 3"},
      {SPARSE("2", R"("bufferView":1,"componentType":5126)", R"("bufferView":2)"), "reach beyond"},
      {SPARSE("2", R"("bufferView":2,"componentType":5126)", R"("bufferView":2)"), "no whole numbers"},
      {SPARSE("2", R"("bufferView":9,"componentType":5123)", R"("bufferView":2)"), "no buffer view"},
      {SPARSE("2", R"("bufferView":1,"componentType":5123)", R"("bufferView":1)"), "reach beyond"},
      {SPARSE("2", R"("bufferView":0,"byteOffset":12,"componentType":5125)", R"("bufferView":2)"), "of 3"},
      {R"("sparse":7)", "of 3 rows"},
  };
#undef SPARSE
  for (const auto& row : wrong) {
    const std::string accessor =
        R"([{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",)" + std::string(row.first) + "}]";
    CHECK_MESSAGE(has(refused(with(accessor.c_str())), row.second), accessor);
  }
}

TEST_CASE(
    "a file that is cut off anywhere is refused with a message, and so is one with any byte changed or still whole") {
  const File file;
  std::string json = file.text();
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string whole = glb(json, std::string(36, '\0'));
  REQUIRE(read(whole).has_value());
  for (std::size_t size = 0; size < whole.size(); ++size) CHECK_FALSE(refused(whole.substr(0, size)).empty());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ 0x15);
    (void)refused(changed);
  }
}

TEST_CASE("hostile files are refused, each by what is wrong with it") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  CHECK(has(refused("no file"), "no glTF"));
  CHECK(has(refused(R"({"asset":{"version":"1.0"}})"), "glTF 1.0"));
  CHECK(has(refused(R"({"asset":{"version":"2.1","minVersion":"2.1"}})"), "requires glTF 2.1"));
  CHECK(has(refused("{" + std::string(2'000'000, '[')), "values"));
  CHECK(has(refused(File{.nodes = R"([{"mesh":0,"children":[1]},{"children":[0]}])"}), "below itself"));
  CHECK(has(refused(File{.nodes = R"([{"mesh":0,"children":[7]}])"}), "none of its 1"));
  CHECK(has(refused(File{.nodes = R"([{"mesh":4294967295}])"}), "mesh is none"));
  CHECK(has(refused(File{.nodes = R"([{"mesh":0,"translation":[1e300,0,0]}])"}), "further than"));
  CHECK(has(refused(File{.positions = bytes_of<float>({0, 0, 0, 1, nan, 0, 0, 1, 0})}), "number 1 of row 1"));
  const auto accessor = [](const char* text) { return File{.accessors = text}; };
  CHECK(has(refused(accessor(R"([{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}])")), "reach beyond"));
  CHECK(
      has(refused(accessor(R"([{"bufferView":0,"componentType":5126,"count":4000000000,"type":"VEC3"}])")), "counts"));
  CHECK(has(
      refused(accessor(R"([{"bufferView":0,"byteOffset":4294967295,"componentType":5126,"count":1,"type":"VEC3"}])")),
      "reach beyond"));
  CHECK(has(refused(accessor(R"([{"bufferView":9,"componentType":5126,"count":3,"type":"VEC3"}])")), "no buffer view"));
  CHECK(has(refused(accessor(R"([{"bufferView":0,"componentType":5126,"count":3,"type":"VEC2"}])")), "numbers a row"));
  CHECK(has(refused(accessor(R"([{"bufferView":0,"componentType":1,"count":3,"type":"VEC3"}])")), "its type"));
  CHECK(has(refused(File{.views = R"([{"buffer":0,"byteOffset":30,"byteLength":36}])"}), "reaches beyond buffer"));
  CHECK(has(refused(File{.views = R"([{"buffer":3,"byteLength":36}])"}), "no buffer"));
  CHECK(has(refused(File{.primitives = R"([{"attributes":{"POSITION":0},"indices":1}])",
                         .accessors =
                             R"([{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
                             R"({"bufferView":0,"byteOffset":12,"componentType":5121,"count":12,"type":"SCALAR"}])"}),
            "of 3"));
  CHECK(has(refused(File{.more = R"("extensionsRequired":["KHR_draco_mesh_compression"],)"}), "draco"));
  // A small file that draws one triangle more often than anybody may.
  const std::vector<std::string> many(90'000, R"({"attributes":{"POSITION":0}})");
  CHECK(has(refused(File{.nodes = R"([{"mesh":0,"children":[1,2]},{"mesh":0},{"mesh":0}])",
                         .primitives = fmt::format("[{}]", fmt::join(many, ","))}),
            "more than 200000 triangles"));
}

TEST_CASE("a material is seen from both sides where its file says so, and from its front alone otherwise") {
  File file;
  file.primitives = R"([{"attributes":{"POSITION":0},"material":0}])";
  for (const auto& [said, two_sided] :
       {std::pair{R"({"doubleSided":true})", true}, std::pair{R"({"doubleSided":false})", false},
        std::pair{"{}", false}, std::pair{R"({"doubleSided":1})", false},
        std::pair{R"({"doubleSided":"true"})", false}}) {
    const std::string material = said;
    CAPTURE(material);
    file.more = fmt::format(R"("materials":[{}],)", said);
    const auto model = read(file);
    REQUIRE(model.has_value());
    CHECK(model->looks.at(0).two_sided == two_sided);
    CHECK_FALSE(model->looks.back().two_sided);
  }
}

TEST_CASE("what lies in another file is never opened") {
  for (const char* uri :
       {"../../../etc/passwd", "/etc/passwd", "file:///etc/passwd", "http://localhost/x", "scene.bin"}) {
    const std::string json =
        fmt::format(R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":1,"uri":"{}"}}]}})", uri);
    CHECK(has(refused(json), "never opened"));
    CHECK(has(refused(File{.primitives = R"([{"attributes":{"POSITION":0},"material":0}])",
                           .more = fmt::format(
                               R"("materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}],)"
                               R"("textures":[{{"source":0}}],"images":[{{"uri":"{}"}}],)",
                               uri)}),
              "never opened"));
  }
}

}  // namespace septet::gltf
