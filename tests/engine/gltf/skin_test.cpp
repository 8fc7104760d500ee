#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/gltf/gltf.hpp"
#include "tests/engine/gltf/file_text.hpp"
#include "tests/why_not.hpp"

namespace septet::gltf {
namespace {

Expected<Model> read_skinned(const File& file) {
  return read_gltf(file.text(), "own.glb", [](std::string_view) { return false; });
}

/// A triangle of which the first vertex follows joint 0, the second joint 1, and the third half of each. Its node is
/// moved by 3 m; joint 0 stands at (0, 1, 0), which its inverse bind matrix undoes, joint 1 at (2, 0, 0).
File skinned() {
  const std::vector<float> places{0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::vector<std::uint8_t> joints{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0},
      weights{255, 0, 0, 0, 255, 0, 0, 0, 128, 128, 0, 0};
  const std::vector<float> matrices{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1,
                                    1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1};
  return {.positions = bytes_of(places) + bytes_of(joints) + bytes_of(weights) + bytes_of(matrices),
          .nodes = R"([{"mesh":0,"skin":0,"translation":[0,0,3]},{"translation":[0,1,0]},{"translation":[2,0,0]}])",
          .scene_nodes = "[0,1,2]",
          .primitives = R"([{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}}])",
          .accessors = R"([{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
                       R"({"bufferView":0,"byteOffset":36,"componentType":5121,"count":3,"type":"VEC4"},)"
                       R"({"bufferView":0,"byteOffset":48,"componentType":5121,"normalized":true,"count":3,)"
                       R"("type":"VEC4"},)"
                       R"({"bufferView":0,"byteOffset":60,"componentType":5126,"count":2,"type":"MAT4"}])",
          .more = R"("skins":[{"joints":[1,2],"inverseBindMatrices":3}],)"};
}

}  // namespace

TEST_CASE("a skinned mesh stands as its joints do, wherever its own node is") {
  const auto model = read_skinned(skinned());
  REQUIRE_MESSAGE(model.has_value(), why_not(model));
  const auto& places = model->parts.at(0).mesh.vertices_m;
  REQUIRE(places.size() == 3);
  const auto is_near = [](const glm::vec3& p, const glm::vec3& wanted) { return glm::distance(p, wanted) < 1e-6f; };
  CHECK(is_near(places[0], {0, 0, 0}));
  CHECK(is_near(places[1], {0, 3, 0}));  // glTF's x is y here.
  CHECK(is_near(places[2], {0, 1, 1}));
}

TEST_CASE("without inverse bind matrices the joints' places are taken as they are") {
  File file = skinned();
  file.more = R"("skins":[{"joints":[1,2]}],)";
  const auto model = read_skinned(file);
  REQUIRE_MESSAGE(model.has_value(), why_not(model));
  CHECK(glm::distance(model->parts.at(0).mesh.vertices_m.at(0), glm::vec3(0, 0, 1)) < 1e-6f);
}

TEST_CASE("joints that mirror a mesh turn its triangles round") {
  File file = skinned();
  file.nodes = R"([{"mesh":0,"skin":0},{"scale":[-1,1,1]},{"scale":[-1,1,1]}])";
  file.more = R"("skins":[{"joints":[1,2]}],)";
  const auto model = read_skinned(file);
  REQUIRE_MESSAGE(model.has_value(), why_not(model));
  const geometry::PolygonMesh& mesh = model->parts.at(0).mesh;
  const auto at = [&](std::size_t k) { return mesh.vertices_m[mesh.polygons[0][k]]; };
  CHECK(glm::cross(at(1) - at(0), at(2) - at(0)).x > 0.0f);
}

TEST_CASE("a skin that is not whole is refused by what it lacks") {
  const auto with = [](const char* skins) {
    File file = skinned();
    file.more = skins;
    return file;
  };
  CHECK(why_refused(read_skinned(with(""))) == "its skin is none of the file's 0");
  CHECK(why_refused(read_skinned(with(R"("skins":[{}],)"))) == "it has 0 joints, not 1 to 1024");
  CHECK(why_refused(read_skinned(with(R"("skins":[7],)"))) == "it has 0 joints, not 1 to 1024");
  CHECK(why_refused(read_skinned(with(R"("skins":[{"joints":[1,9]}],)"))) == "its joint 1 is no node of the scene");
  CHECK(why_refused(read_skinned(with(R"("skins":[{"joints":[1]}],)"))) == "a vertex follows joint 1 of 1");
  CHECK(why_refused(read_skinned(with(R"("skins":[{"joints":[1,2,0],"inverseBindMatrices":3}],)"))) ==
        "it has 2 inverse bind matrices of 3 joints");
  CHECK(why_refused(read_skinned(with(R"("skins":[{"joints":[1,2],"inverseBindMatrices":0}],)"))) ==
        "it has 3 numbers a row, not 16");
  File outside = skinned();
  outside.scene_nodes = "[0,1]";
  CHECK(why_refused(read_skinned(outside)) == "its joint 1 is no node of the scene");
  File unbound = skinned();
  unbound.primitives = R"([{"attributes":{"POSITION":0,"JOINTS_0":1}}])";
  CHECK(why_refused(read_skinned(unbound)) == "there is none: the file has 4");
}

}  // namespace septet::gltf
