#include "tests/engine/scenery/world/ground_over_lanes.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "tests/conformance/conformance_data.hpp"
#include "tests/engine/road/crossing_roads.hpp"

namespace septet::scenery {
namespace {

void check_clear(const std::string& name, const road::RoadNetwork& network,
                 double overrun_m = roadside::usual_overrun_m) {
  CAPTURE(name);
  scene::Store store;
  scene::SceneBuilder builder(store);
  build_road_world(builder, network, 1, {.vegetation = false, .buildings = false, .overrun_m = overrun_m});
  const Buried found = buried_lanes(network, store);
  REQUIRE(found.places > 100);
  INFO(found.worst);
  CHECK(found.buried == 0);
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
  for (const char* name : {"Town01", "Town03"})
    check_clear(name, read_file(conformance_data("towns") / fmt::format("{}.xodr", name)));
  for (const char* name : {"fabriksgatan", "multi_intersections", "soderleden"})
    check_clear(name, third_party_road(name));
}

}  // namespace septet::scenery
