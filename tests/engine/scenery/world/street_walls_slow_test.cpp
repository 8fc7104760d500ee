#include <string>
#include <string_view>
#include <variant>

#include <doctest/doctest.h>

#include "engine/road/opendrive_reader.hpp"
#include "engine/scene/node.hpp"
#include "engine/scene/store.hpp"
#include "engine/scenery/world/road_world.hpp"
#include "tests/engine/road/road_files.hpp"
#include "tests/engine/scenery/world/kind_of.hpp"
#include "tests/shipped_files.hpp"

namespace septet::scenery {
namespace {

bool is_in_street(const scene::Node* material) {
  const scene::TagValue* value = material ? scene::find_tag(*material, "surface", "in_street") : nullptr;
  const bool* is = value ? std::get_if<bool>(value) : nullptr;
  return is && *is;
}

struct Walled {
  int houses = 0, houses_with_street_walls = 0, farms_and_churches = 0, others_with_street_walls = 0;
};

Walled walled(const road::RoadNetwork& network) {
  scene::Store store;
  scene::SceneBuilder builder(store);
  build_road_world(builder, network, 1);
  Walled result;
  for (const auto& [id, node] : store.nodes()) {
    const auto* object = std::get_if<scene::ObjectData>(&node.data);
    if (!object) continue;
    bool in_street = false;
    for (const auto& [link_id, link] : object->links)
      in_street = in_street || (link.label == "material" && is_in_street(store.find(link.target)));
    const std::string_view kind = kind_of(node.name);
    if (kind == "lit windows") continue;  // Panes before a house's walls, or none.
    const bool house = kind == "town house";
    result.houses += house;
    result.farms_and_churches += kind == "building";
    (house ? result.houses_with_street_walls : result.others_with_street_walls) += in_street;
  }
  return result;
}

}  // namespace

TEST_CASE("every house of a village has walls along a street and nothing else there or beside a motorway has") {
  const auto village =
      road::read_opendrive(shipped_text("scenarios/first-lesson/first-lesson.xodr"), "first-lesson.xodr");
  REQUIRE(village.has_value());
  const Walled in_village = walled(*village), beside_motorway = walled(road::motorway());
  CHECK(in_village.houses > 20);
  CHECK(in_village.houses_with_street_walls == in_village.houses);
  CHECK(in_village.others_with_street_walls == 0);
  CHECK(beside_motorway.farms_and_churches > 3);
  CHECK(beside_motorway.others_with_street_walls == 0);
}

}  // namespace septet::scenery
