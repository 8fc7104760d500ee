#include "engine/roadside/street.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/roadside/obstacles.hpp"
#include "engine/roadside/plants.hpp"
#include "engine/roadside/signals.hpp"
#include "tests/engine/road/third_party_road.hpp"

namespace septet::roadside {
namespace {

using road::third_party_road;

std::vector<Vec2> places_in(const TownHouse& house) {
  const TownHouseSize size = size_of(house.kind);
  std::vector<Vec2> places;
  for (double y = -0.5; y <= 0.5; y += 0.25)
    for (double x = -0.5; x <= 0.5; x += 0.25)
      places.emplace_back(house.world_from_house * Vec3(size.length_m * x, size.depth_m * y, 0.0));
  return places;
}

}  // namespace

TEST_CASE("houses line a town's streets and stand on no lane, in no other house and before no signal") {
  for (const char* name : {"fabriksgatan", "multi_intersections"}) {
    CAPTURE(std::string(name));
    const road::RoadNetwork network = third_party_road(name);
    const RoadShape roads(network, 0.0);
    const std::vector<TownHouse> houses = town_houses(roads, 3);
    CHECK(houses.size() > 30);
    int on_road = 0, in_house = 0, at_signal = 0;
    for (std::size_t i = 0; i < houses.size(); ++i) {
      const std::vector<Vec2> places = places_in(houses[i]);
      for (const Vec2& p : places) {
        const auto found = road::locate(network, p, nullptr, 3.0);
        on_road += found && found->lanes.outside_m < 1.5;
        for (std::size_t k = 0; k < houses.size(); ++k) in_house += k != i && is_in_house({houses[k]}, p, 1.0);
      }
    }
    for (const StandingSignal& signal : standing_signals(roads))
      at_signal += is_in_house(houses, Vec2(signal.world_from_signal.position_m), 2.5);
    CHECK(on_road == 0);
    CHECK(in_house == 0);
    CHECK(at_signal == 0);
  }
}

TEST_CASE("a town's houses depend on the seed, and the motorway has none") {
  const road::RoadNetwork network = third_party_road("fabriksgatan");
  const RoadShape roads(network, 0.0);
  const auto places = [&](std::uint64_t seed) {
    std::vector<double> result;
    for (const TownHouse& house : town_houses(roads, seed)) result.push_back(house.world_from_house.position_m.x);
    return result;
  };
  CHECK(places(3) == places(3));
  CHECK(places(3) != places(4));
  const RoadShape motorway(road::motorway(), 0.0);
  CHECK(town_houses(motorway, 3).empty());
  CHECK(street_lamps(motorway).empty());
}

TEST_CASE("a street lamp stands beside the lanes that are driven on, never on one, and reaches towards its road") {
  for (const char* name : {"fabriksgatan", "multi_intersections"}) {
    const road::RoadNetwork network = third_party_road(name);
    const std::vector<StreetLamp> lamps = street_lamps(RoadShape(network, 0.0));
    CHECK(lamps.size() > 15);
    int on_lane = 0, turned_away = 0;
    for (const StreetLamp& lamp : lamps) {
      for (const road::Location& location : road::roads_holding(network, Vec2(lamp.world_from_lamp.position_m))) {
        const road::LaneType type =
            road::lane_type(network, location.position.road, location.lanes.lane_any_type, location.position.s_m);
        on_lane += type != road::LaneType::none && type != road::LaneType::sidewalk;
      }
      const auto reached = road::locate(network, Vec2(lamp.world_from_lamp * Vec3(2.0, 0, 0)));
      turned_away += !reached || reached->lanes.outside_m > 0.0;
    }
    CHECK(on_lane == 0);
    CHECK(turned_away == 0);
  }
}

TEST_CASE("no tree grows in a house, and houses and lamps are run against") {
  const road::RoadNetwork network = third_party_road("fabriksgatan");
  const RoadShape roads(network, 200.0);
  const Terrain terrain(roads, 3);
  const std::vector<TownHouse> houses = town_houses(roads, 3);
  REQUIRE(!houses.empty());
  const auto trees = planted_trees(roads, terrain, 3);
  CHECK(std::ranges::none_of(trees, [&](const Tree& tree) { return is_in_house(houses, Vec2(tree.foot_m), 3.0); }));
  const Obstacles obstacles(network, 3, 200.0);
  const auto hit = [&](const Vec2& p, ObstacleKind kind) {
    const auto near = obstacles.near(p, 1.0);
    return std::ranges::any_of(near, [&](const Obstacle& obstacle) { return obstacle.kind == kind; });
  };
  const TownHouseSize size = size_of(houses[0].kind);
  CHECK(hit(Vec2(houses[0].world_from_house * Vec3(0.0, -0.5 * size.depth_m, 0.0)), ObstacleKind::house));
  CHECK(hit(Vec2(street_lamps(roads).at(0).world_from_lamp.position_m), ObstacleKind::post));
}

}  // namespace septet::roadside
