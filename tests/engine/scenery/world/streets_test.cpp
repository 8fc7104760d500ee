#include <map>
#include <set>
#include <string>
#include <string_view>
#include <variant>

#include <doctest/doctest.h>

#include "tests/engine/road/crossing_roads.hpp"
#include "tests/engine/scenery/world/kind_of.hpp"
#include "tests/engine/scenery/world/part_of_world.hpp"

namespace septet::scenery {
namespace {

const scene::Store& street() {
  static const scene::Store store =
      part_of_world(road::laid({{.id = "street", .pieces = {{600, 0}}, .has_walk = true}}), build_streets);
  return store;
}

/// Calls `visit` with each object of the kind and its data.
template <class Visit>
int for_each(std::string_view kind, const Visit& visit) {
  int count = 0;
  for (const auto& [id, node] : street().nodes()) {
    const auto* object = std::get_if<scene::ObjectData>(&node.data);
    if (!object || kind_of(node.name) != kind) continue;
    ++count;
    visit(node, *object);
  }
  return count;
}

}  // namespace

TEST_CASE("houses of a street are drawn as far as 2.5 km, their lit windows 900 m and its lamps 450 m") {
  const std::map<std::string_view, double> furthest_m{
      {"town house", 2500.0}, {"lit windows", 900.0}, {"street lamp", 450.0}};
  for (const auto& entry : furthest_m) {
    CAPTURE(entry.first);
    const int count = for_each(entry.first, [&](const scene::Node& node, const scene::ObjectData&) {
      const scene::TagValue* value = scene::find_tag(node, "draw", "to_m");
      REQUIRE(value != nullptr);
      CHECK(std::get<double>(*value) == entry.second);
    });
    CHECK(count > 10);
  }
}

TEST_CASE("a street's white and red houses have roofs of tiles, and its yellow and grey ones dark roofs") {
  std::map<std::string, int> houses;
  for_each("town house", [&](const scene::Node&, const scene::ObjectData& house) {
    std::set<std::string> worn;
    for (const auto& [id, link] : house.links)
      if (link.label == "material") worn.insert(street().find(link.target)->name);
    const bool tiles = worn.contains(name_of(Ground::roof_tiles));
    for (const Ground plaster :
         {Ground::facade_white, Ground::facade_red, Ground::facade_yellow, Ground::facade_grey}) {
      if (!worn.contains(name_of(plaster))) continue;
      ++houses[name_of(plaster)];
      CHECK(tiles == (plaster == Ground::facade_white || plaster == Ground::facade_red));
    }
  });
  CHECK(houses.size() == 4);
}

}  // namespace septet::scenery
