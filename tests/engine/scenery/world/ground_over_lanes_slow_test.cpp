#include "tests/engine/scenery/world/ground_over_lanes.hpp"

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "tests/conformance/conformance_data.hpp"
#include "tests/engine/road/crossing_roads.hpp"

namespace septet::scenery {
namespace {

void check_clear(const std::string& name, const road::RoadNetwork& network, std::size_t owed = 0,
                 double overrun_m = roadside::usual_overrun_m) {
  CAPTURE(name);
  scene::Store store;
  scene::SceneBuilder builder(store);
  build_road_world(builder, network, 1, {.vegetation = false, .buildings = false, .overrun_m = overrun_m});
  const Buried found = buried_lanes(network, store);
  REQUIRE(found.places > 100);
  INFO(found.worst);
  CHECK(found.buried <= owed);
}

road::RoadNetwork read_file(const std::filesystem::path& path) {
  std::ifstream file(path);
  return road::read_or_fail({std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()});
}

}  // namespace

TEST_CASE("no ground is drawn over a lane where roads cross on two levels or lie close beside one another") {
  check_clear("two levels", road::two_levels());
  check_clear("terraces", road::terraces());
  check_clear("sharp bend", road::sharp_bend());
  check_clear("ramp below a motorway", road::ramp_below());
  check_clear("spiral", road::spiral());
  check_clear("junction below a deck", road::junction_below_deck());
}

TEST_CASE("no ground is drawn over a lane of the shipped roads") {
  for (const char* path : {"scenarios/first-lesson/first-lesson.xodr", "scenarios/motorway-ambulance/motorway.xodr"})
    check_clear(path, road::read_or_fail(shipped_text(path)));
}

TEST_CASE("no ground is drawn over a lane of a public town") {
  // Of Town03's 36,840 places 7 lie up to 7 cm under a sliver of verge between two rows.
  for (const auto& [name, owed] : {std::pair{"Town01", std::size_t{0}}, {"Town03", std::size_t{7}}})
    check_clear(name, read_file(conformance_data("towns") / (std::string(name) + ".xodr")), owed);
  for (const char* name : {"fabriksgatan", "multi_intersections", "soderleden"})
    check_clear(name, third_party_road(name));
}

}  // namespace septet::scenery
