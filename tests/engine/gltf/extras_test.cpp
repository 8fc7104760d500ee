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

Model with(const std::string& nodes, const char* scene = "[0,1]") {
  auto model =
      read_gltf(File{.nodes = nodes, .scene_nodes = scene}.text(), "own.glb", [](std::string_view) { return false; });
  REQUIRE_MESSAGE(model.has_value(), why_not(model));
  return std::move(*model);
}

}  // namespace

TEST_CASE("properties of nodes are read by their kind, and the first of a name counts") {
  const Model model = with(R"([{"mesh":0,"extras":{"solid":true,"mass_kg":12,"kind":"deer","size":[1,2.5,3]}},)"
                           R"({"extras":{"mass_kg":13,"solid":"yes","more":-0.5}},{"extras":{"unseen":1}}])");
  CHECK(model.left_out.empty());
  CHECK(model.extras == std::vector<Extra>{{"kind", std::string("deer")},
                                           {"mass_kg", 12.0},
                                           {"size", glm::dvec3(1, 2.5, 3)},
                                           {"solid", true},
                                           {"more", -0.5}});
}

TEST_CASE("a property of no kind that a tag has is told once, and extras that are no object are none") {
  const Model model = with(R"([{"mesh":0,"extras":{"a":null,"b":[1,2],"c":{"d":1}}},{"extras":{"a":null}}])");
  CHECK(model.extras.empty());
  CHECK(model.left_out == std::vector<std::string>{
                              "the property \"a\" (extras) is no truth, number, short text or list of three numbers",
                              "the property \"b\" (extras) is no truth, number, short text or list of three numbers",
                              "the property \"c\" (extras) is no truth, number, short text or list of three numbers"});
  for (const char* none : {"7", "[1]", "null", R"("text")"}) {
    const Model empty = with(fmt::format(R"([{{"mesh":0,"extras":{}}}])", none), "[0]");
    CHECK(empty.extras.empty());
    CHECK(empty.left_out.empty());
  }
}

TEST_CASE("of a hostile number of properties sixty-four are read, and long texts are not") {
  std::string many = fmt::format(R"("long":"{}")", std::string(1001, 'x'));
  for (int i = 0; i < 200; ++i) many += fmt::format(R"(,"p{}":{})", i, i);
  const Model model = with(fmt::format(R"([{{"mesh":0,"extras":{{{}}}}}])", many), "[0]");
  CHECK(model.extras.size() == 64);
  CHECK(model.left_out.size() == 2);
}

}  // namespace septet::gltf
