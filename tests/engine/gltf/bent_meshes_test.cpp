#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/gltf/gltf.hpp"
#include "engine/math/pose_keys.hpp"
#include "tests/engine/gltf/file_text.hpp"
#include "tests/why_not.hpp"

namespace septet::gltf {
namespace {

/// A triangle that follows joint 1, which goes 4 m along z in 2 s; the joint hangs on node 2, a target moves the
/// triangle by 3 m along y. `path` says which of the two the animation moves.
File bent(const char* node, const char* path, const std::vector<float>& values) {
  const std::vector<float> places{0, 0, 0, 1, 0, 0, 0, 1, 0}, target{0, 3, 0, 0, 3, 0, 0, 3, 0}, times_s{0, 2};
  const std::vector<std::uint8_t> joints(12, 0);
  const std::vector<float> weights{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
  return {
      .positions = bytes_of(places) + bytes_of(target) + bytes_of(joints) + bytes_of(weights) + bytes_of(times_s) +
                   bytes_of(values),
      .nodes = R"([{"mesh":0,"skin":0},{},{"children":[1]},{"mesh":0,"translation":[0,0,7]}])",
      .scene_nodes = "[0,2]",
      .primitives = R"([{"attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3},"targets":[{"POSITION":1}]}])",
      .accessors = fmt::format(R"([{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}},)"
                               R"({{"bufferView":0,"byteOffset":36,"componentType":5126,"count":3,"type":"VEC3"}},)"
                               R"({{"bufferView":0,"byteOffset":72,"componentType":5121,"count":3,"type":"VEC4"}},)"
                               R"({{"bufferView":0,"byteOffset":84,"componentType":5126,"count":3,"type":"VEC4"}},)"
                               R"({{"bufferView":0,"byteOffset":132,"componentType":5126,"count":2,"type":"SCALAR"}},)"
                               R"({{"bufferView":0,"byteOffset":140,"componentType":5126,"count":2,"type":"{}"}}])",
                               values.size() == 2 ? "SCALAR" : "VEC3"),
      .more = fmt::format(R"("skins":[{{"joints":[1]}}],"animations":[{{"samplers":[{{"input":4,"output":5}}],)"
                          R"("channels":[{{"sampler":0,"target":{{"node":{},"path":"{}"}}}}]}}],)",
                          node, path)};
}
Model bent_model(const File& file) {
  const auto model = read_gltf(file.text(), "own.glb", [](std::string_view name) { return name == "wheel"; });
  REQUIRE_MESSAGE(model.has_value(), why_not(model));
  return *model;
}

/// Places of the first vertex in all parts that have a size at a time.
std::vector<glm::vec3> shown_at(const Model& model, double time_s) {
  std::vector<glm::vec3> places;
  for (const Part& part : model.parts) {
    PoseKey pose;
    if (!part.keys.empty()) pose = keyed_pose(part.keys, time_s);
    if (pose.scale == glm::vec3(0.0f)) continue;
    places.push_back(pose.position_m + pose.rotation * (pose.scale * part.mesh.vertices_m.at(0)));
  }
  return places;
}

}  // namespace

TEST_CASE("a mesh whose joints move is there in one pose at any time, which is that of its joints within a step") {
  const Model model = bent_model(bent("2", "translation", {0, 0, 0, 0, 0, 4}));
  CHECK(model.parts.size() == 60);
  for (const double time_s : {0.0, 0.01, 0.5, 1.0, 1.234, 1.99, 2.5, 61.1}) {
    CAPTURE(time_s);
    const auto shown = shown_at(model, time_s);
    REQUIRE(shown.size() == 1);
    const double wanted_m = 2.0 * std::fmod(time_s, 2.0);
    CHECK(std::abs(double(shown[0].x) - wanted_m) < 0.035);
  }
  CHECK(model.left_out ==
        std::vector<std::string>{"mesh 0 is bent by joints or morph targets: it moves in 60 poses, one each 0.033 s"});
  CHECK(model.most_m.x < 0.1f);  // That of the beginning.
}

TEST_CASE("weights of morph targets move a mesh by the animation's values") {
  File file = bent("3", "weights", {0, 1});
  file.scene_nodes = "[3]";
  file.primitives = R"([{"attributes":{"POSITION":0},"targets":[{"POSITION":1}]}])";
  const Model model = bent_model(file);
  for (const double time_s : {0.0, 0.7, 1.9}) {
    const auto shown = shown_at(model, time_s);
    REQUIRE(shown.size() == 1);
    CHECK(glm::distance(shown[0], glm::vec3(7, 0, 1.5 * time_s)) < 0.03f);  // glTF's y is z here.
  }
}

TEST_CASE("a bent mesh below a part that moves by its name stands as in the file, which is told") {
  File file = bent("2", "translation", {0, 0, 0, 0, 0, 4});
  file.nodes = R"([{"mesh":0,"skin":0,"name":"wheel"},{},{"children":[1]},{}])";
  const Model model = bent_model(file);
  CHECK(model.parts.size() == 1);
  CHECK(model.left_out ==
        std::vector<std::string>{"mesh 0 is bent by joints or morph targets below a part that moves by its name: it "
                                 "stands as it does in the file"});
}

TEST_CASE("a bent mesh of many vertices has fewer poses, and one of too many stands as in the file") {
  const auto poses_of = [](std::size_t vertices) {
    File file = bent("3", "weights", {0, 1});
    file.scene_nodes = "[3]";
    const std::size_t first = file.positions.size();
    file.positions += std::string(vertices * 12, '\0');
    // The target has no rows; of the vertices three are a triangle.
    file.primitives = R"([{"attributes":{"POSITION":6},"indices":7,"targets":[{}]}])";
    file.positions.replace(first, 36, bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}));
    file.positions += bytes_of<std::uint32_t>({0, 1, 2});
    file.accessors.pop_back();
    file.accessors +=
        fmt::format(R"(,{{"bufferView":0,"byteOffset":{},"componentType":5126,"count":{},"type":"VEC3"}},)"
                    R"({{"bufferView":0,"byteOffset":{},"componentType":5125,"count":3,"type":"SCALAR"}}])",
                    first, vertices, first + 12 * vertices);
    return bent_model(file);
  };
  CHECK(poses_of(10'000).parts.size() == 19);
  const Model large = poses_of(150'000);
  CHECK(large.parts.size() == 1);
  CHECK(large.left_out == std::vector<std::string>{
                              "mesh 0 is bent by joints or morph targets, and too large to be kept in several poses: "
                              "it stands as it does in the file"});
}

}  // namespace septet::gltf
