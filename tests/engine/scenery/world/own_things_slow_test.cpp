// User's own trees, houses, lamps and posts in place of the generated ones, each with the measures of its file.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "engine/gltf/gltf.hpp"
#include "engine/road/opendrive_reader.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scenery/world/road_world.hpp"
#include "tests/engine/scenery/world/kind_of.hpp"
#include "tests/shipped_files.hpp"

namespace septet::scenery {
namespace {

/// glTF file of one triangle, a metre wide and a metre high, of a unique colour.
std::string file_of(double red) {
  return fmt::format(
      R"({{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],)"
      R"("materials":[{{"name":"look","pbrMetallicRoughness":{{"baseColorFactor":[{},0.25,0.5,1]}}}}],)"
      R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"material":0}}]}}],)"
      R"("accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}}],"bufferViews":[{{"buffer":0,"byteLength":36}}],)"
      R"("buffers":[{{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}}]}})",
      red);
}

double red_of(std::size_t thing) { return 0.0625 * static_cast<double>(thing + 1); }

OwnModels own_things() {
  OwnModels own;
  const auto things = replaceable_things();
  for (std::size_t i = 0; i < things.size(); ++i) {
    auto model = gltf::read_gltf(file_of(red_of(i)), things[i], begins_own_part);
    REQUIRE_MESSAGE(model.has_value(), things[i]);
    own.emplace(std::string(things[i]), std::move(*model));
  }
  return own;
}

using Place = std::tuple<double, double, double>;
/// Places of the objects of each kind, in order; for trees their nearest level.
using Places = std::map<std::string, std::vector<Place>, std::less<>>;

scene::Store world_of(const char* roads, const OwnModels* own) {
  const auto network = road::read_opendrive(shipped_text(roads), roads);
  REQUIRE(network.has_value());
  scene::Store store;
  scene::SceneBuilder builder(store);
  build_road_world(builder, *network, 1, {.own = own});
  return store;
}

Places places_in(const scene::Store& store) {
  Places places;
  for (const auto& [id, node] : store.nodes()) {
    const auto* object = std::get_if<scene::ObjectData>(&node.data);
    if (!object) continue;
    const scene::TagValue* from = scene::find_tag(node, "draw", "from_m");
    if (from && std::get<double>(*from) > 0.0) continue;
    const Vec3& at = object->transform.position_m;
    places[std::string(kind_of(node.name))].emplace_back(at.x, at.y, at.z);
  }
  for (auto& [name, all] : places) std::ranges::sort(all);
  return places;
}

std::vector<Place> together(const Places& places, std::initializer_list<std::string_view> names) {
  std::vector<Place> all;
  for (const std::string_view name : names)
    if (const auto found = places.find(name); found != places.end())
      all.insert(all.end(), found->second.begin(), found->second.end());
  std::ranges::sort(all);
  return all;
}

}  // namespace

TEST_CASE("own trees, houses, lamps and posts stand in the place of the generated ones, each in its own look") {
  const OwnModels own = own_things();
  std::map<std::string_view, int> drawn;
  for (const char* roads : {"scenarios/first-lesson/first-lesson.xodr", "scenarios/motorway-ambulance/motorway.xodr"}) {
    CAPTURE(roads);
    const scene::Store store = world_of(roads, &own);
    const Places generated = places_in(world_of(roads, nullptr)), replaced = places_in(store);
    CHECK(together(replaced, {"oak", "birch", "spruce", "bush"}) == together(generated, {"tree"}));
    CHECK(together(replaced, {"red-farm", "white-farm", "church"}) == together(generated, {"building"}));
    CHECK(together(replaced, {"cottage", "town-house", "town-block"}) == together(generated, {"town house"}));
    CHECK(together(replaced, {"street-lamp"}) == together(generated, {"street lamp"}));
    CHECK(together(replaced, {"tree", "building", "town house", "street lamp"}).empty());
    // View of a renderer.
    const scene::ResolvedScene scene = scene::resolve(store);
    for (const scene::Instance& instance : scene.instances)
      for (const scene::MeshPart& part : scene.meshes.at(instance.mesh).parts)
        for (std::size_t i = 0; i < replaceable_things().size(); ++i) {
          const scene::SurfaceMaterial& material = scene.materials.at(part.material);
          if (std::abs(material.base_color.r - red_of(i)) < 1e-5 && std::abs(material.base_color.g - 0.25f) < 1e-5 &&
              std::abs(material.base_color.b - 0.5f) < 1e-5 && part.index_count == 3)
            ++drawn[replaceable_things()[i]];
        }
  }
  for (const std::string_view thing : replaceable_things()) {
    CAPTURE(thing);
    CHECK(drawn[thing] > 0);
  }
}

}  // namespace septet::scenery
