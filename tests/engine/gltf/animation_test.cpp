#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/gltf/gltf.hpp"
#include "engine/math/pose_keys.hpp"
#include "tests/engine/gltf/file_text.hpp"
#include "tests/relative.hpp"
#include "tests/why_not.hpp"

namespace septet::gltf {
namespace {

Expected<Model> read_moving(const File& file) {
  return read_gltf(file.text(), "own.glb", [](std::string_view name) { return name.starts_with("wheel"); });
}
Model model_of(const File& file) {
  const auto model = read_moving(file);
  REQUIRE_MESSAGE(model.has_value(), why_not(model));
  return *model;
}

/// A triangle whose nodes are moved by one animation: accessor 1 has its times, accessor 2 its values.
File animated(const std::vector<float>& times_s, const std::vector<float>& values, const std::string& channels,
              const char* interpolation = "LINEAR") {
  File file;
  const std::size_t width = channels.find("rotation") == std::string::npos ? 3 : 4, first = file.positions.size();
  file.positions += bytes_of(times_s) + bytes_of(values);
  file.accessors = fmt::format(R"([{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}},)"
                               R"({{"bufferView":0,"byteOffset":{},"componentType":5126,"count":{},"type":"SCALAR"}},)"
                               R"({{"bufferView":0,"byteOffset":{},"componentType":5126,"count":{},"type":"VEC{}"}}])",
                               first, times_s.size(), first + 4 * times_s.size(), values.size() / width, width);
  file.more = fmt::format(
      R"("animations":[{{"name":"opens","samplers":[{{"input":1,"output":2,"interpolation":"{}"}}],"channels":[{}]}}],)",
      interpolation, channels);
  return file;
}
std::string channel(int node, const char* path) {
  return fmt::format(R"({{"sampler":0,"target":{{"node":{},"path":"{}"}}}})", node, path);
}
/// Its node goes 4 m forward in 2 s.
File moving() { return animated({0, 2}, {0, 0, 0, 0, 0, 4}, channel(0, "translation")); }

bool is_near(const glm::vec3& p, const glm::vec3& wanted) { return glm::distance(p, wanted) < 1e-5f; }

/// Place of a vertex of a part at a time.
glm::vec3 place_at(const Part& part, std::size_t vertex, double time_s) {
  const PoseKey pose = keyed_pose(part.keys, time_s);
  return pose.position_m + pose.rotation * (pose.scale * part.mesh.vertices_m.at(vertex));
}

}  // namespace

TEST_CASE("a node that an animation moves is a part of its own, whose keys say where it is") {
  const Model model = model_of(moving());
  REQUIRE(model.parts.size() == 1);
  const Part& part = model.parts[0];
  CHECK(model.left_out.empty());
  REQUIRE(part.keys.size() == 2);
  CHECK(part.name.empty());
  CHECK(is_near(place_at(part, 0, 1.0), {2, 0, 0}));  // glTF's z is x here.
  CHECK(is_near(place_at(part, 1, 1.0), {2, 1, 0}));
  CHECK(is_near(place_at(part, 0, 2.5), {1, 0, 0}));
  CHECK(is_near(model.most_m, {0, 1, 1}));
}

TEST_CASE("a step holds its value until the next time") {
  const Model model = model_of(animated({0, 1, 2}, {0, 0, 1, 0, 0, 2, 0, 0, 3}, channel(0, "translation"), "STEP"));
  CHECK(is_near(place_at(model.parts.at(0), 0, 0.999), {1, 0, 0}));
  CHECK(is_near(place_at(model.parts.at(0), 0, 1.0), {2, 0, 0}));
  CHECK(is_near(place_at(model.parts.at(0), 0, 1.999), {2, 0, 0}));
}

TEST_CASE("a cubic spline follows its slopes") {
  // From 0 to 4 m in 2 s, at rest at both ends, then with 3 m/s at the beginning.
  const auto at_half_second = [](float slope) {
    const Model model = model_of(animated({0, 2}, {0, 0, 0, 0, 0, 0, 0, 0, slope, 0, 0, 0, 0, 0, 4, 0, 0, 0},
                                          channel(0, "translation"), "CUBICSPLINE"));
    return place_at(model.parts.at(0), 0, 0.5).x;
  };
  CHECK(at_half_second(0.0f) == relative(4.0 * (3.0 / 16.0 - 2.0 / 64.0), 1e-4));
  CHECK(at_half_second(3.0f) - at_half_second(0.0f) == relative(2.0 * 3.0 * (1.0 / 64.0 - 2.0 / 16.0 + 0.25), 1e-3));
}

TEST_CASE("what hangs on an animated node moves with it, and on two with both") {
  // A quarter turn about y (up): x goes to −z.
  const float half = 0.70710678f;
  File file = animated({0, 1}, {0, 0, 0, 1, 0, half, 0, half}, channel(0, "rotation"));
  file.nodes = R"([{"children":[1]},{"mesh":0,"translation":[2,0,0]}])";
  const Model one = model_of(file);
  REQUIRE(one.parts.size() == 1);
  CHECK(one.parts[0].keys.size() == 2);
  CHECK(is_near(place_at(one.parts[0], 0, 0.0), {0, 2, 0}));
  CHECK(is_near(place_at(one.parts[0], 0, 1.0 - 1e-9), {-2, 0, 0}));

  File both = animated({0, 1}, {0, 0, 0, 1, 0, half, 0, half}, channel(0, "rotation") + "," + channel(1, "rotation"));
  both.nodes = file.nodes;
  const Model two = model_of(both);
  REQUIRE(two.parts.size() == 1);
  CHECK(two.parts[0].keys.size() == 61);
  // The second vertex lies a metre along x of a node that has turned by half a turn.
  CHECK(is_near(place_at(two.parts[0], 1, 1.0 - 1e-9), {-2, -1, 0}));
}

TEST_CASE("a part that an animation lets grow from nothing keeps its lengths in metres") {
  const Model model = model_of(animated({0, 1}, {0, 0, 0, 500, 500, 500}, channel(0, "scale")));
  const Part& part = model.parts.at(0);
  CHECK(part.keys.front().scale == glm::vec3(0.0f));
  CHECK(is_near(part.mesh.vertices_m.at(1), {0, 500, 0}));
  CHECK(is_near(place_at(part, 1, 0.5), {0, 250, 0}));
}

TEST_CASE("a moving node that mirrors has its triangles turned round, and keys that do not mirror") {
  for (const bool mirrors : {false, true}) {
    CAPTURE(mirrors);
    File file = moving();
    file.nodes = fmt::format(R"([{{"mesh":0,"scale":[{},2,2]}}])", mirrors ? -2 : 2);
    const Part part = model_of(file).parts.at(0);
    for (const PoseKey& key : part.keys) CHECK(key.scale.x * key.scale.y * key.scale.z > 0.0f);
    // glTF's x is y here: the corners (0, 0, 0), (1, 0, 0), (0, 1, 0) of a triangle that looks forward.
    glm::vec3 sum(0.0f);
    const auto& corners = part.mesh.polygons.at(0);
    for (std::size_t k = 0; k < 3; ++k) sum += place_at(part, corners[k], 1.0);
    CHECK(is_near(sum, {6, mirrors ? -2 : 2, 2}));
    const glm::vec3 first = place_at(part, corners[0], 1.0);
    const glm::vec3 front =
        glm::cross(place_at(part, corners[1], 1.0) - first, place_at(part, corners[2], 1.0) - first);
    CHECK(front.x > 0.0f);
  }
}

TEST_CASE("a part that moves by its name is moved by no animation, which is told") {
  File file = moving();
  file.nodes = R"([{"mesh":0,"name":"wheel_left"}])";
  const Model model = model_of(file);
  CHECK(model.parts.at(0).keys.empty());
  CHECK(model.left_out == std::vector<std::string>{"node \"wheel_left\" moves by its name, and no animation moves it"});
}

TEST_CASE("of two animations that move one thing the first plays, and the rest is told") {
  File file = moving();
  file.more = R"("animations":[{"samplers":[{"input":1,"output":2}],"channels":[)" + channel(0, "translation") +
              R"(]},{"name":"back","samplers":[{"input":1,"output":2}],"channels":[)" + channel(0, "translation") +
              "," + channel(0, "weights") + R"(,{"target":{"path":"pointer"}}]}],)";
  const Model model = model_of(file);
  CHECK(model.parts.at(0).keys.size() == 2);
  CHECK(model.left_out ==
        std::vector<std::string>{
            "animation \"back\" moves what an earlier one moves: there the earlier one is played",
            "animation \"back\" moves the weights of no morph targets, or of more than 256, which is not played",
            "animation \"back\" moves something else than nodes, which is not played"});
}

TEST_CASE("an animation that is not whole is refused by its channel") {
  CHECK(why_refused(read_moving(animated({0, 2}, {0, 0, 0}, channel(0, "translation")))) ==
        "it has 1 values at 2 times");
  CHECK(why_refused(read_moving(animated({2, 1}, {0, 0, 0, 0, 0, 0}, channel(0, "translation")))) ==
        "its times do not rise from 0 to at most 3600 s: 1 s follows 2 s");
  CHECK(why_refused(read_moving(animated({0, 1}, {0, 0, 0, 0, 0, 0}, channel(7, "translation")))) ==
        "it moves no node of the file");
  File without = moving();
  without.more = R"("animations":[{"channels":[)" + channel(0, "scale") + "]}],";
  CHECK(why_refused(read_moving(without)) == "its sampler is none of 0");
  CHECK(why_refused(read_moving(animated({0, 1}, {0, 0, 0, 0, 0, 9000}, channel(0, "translation")))) ==
        "it lies further than 2000 m from the origin");
}

TEST_CASE("an animation of more keys than a part may have is taken at even steps") {
  std::vector<float> times_s, values;
  for (int i = 0; i < 4000; ++i) {
    times_s.push_back(0.01f * static_cast<float>(i));
    values.insert(values.end(), {0.0f, 0.0f, times_s.back()});
  }
  const Model model = model_of(animated(times_s, values, channel(0, "translation")));
  CHECK(model.parts.at(0).keys.size() <= max_pose_keys);
  CHECK(place_at(model.parts.at(0), 0, 20.0).x == relative(20.0, 1e-3));
}

}  // namespace septet::gltf
