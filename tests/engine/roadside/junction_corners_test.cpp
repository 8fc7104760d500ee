#include "engine/roadside/junction_corners.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/roadside/parked_cars.hpp"
#include "engine/roadside/raised_areas.hpp"
#include "engine/roadside/street_furniture.hpp"
#include "tests/engine/road/third_party_road.hpp"
#include "tests/shipped_files.hpp"

namespace septet::roadside {
namespace {

road::RoadNetwork town() { return road::read_or_fail(shipped_text("scenarios/town/town.xodr")); }

bool is_driven(const road::RoadNetwork& network, const Vec2& p) {
  for (const road::Location& location : road::roads_holding(network, p)) {
    const road::RoadPosition& at = location.position;
    if (road::is_drivable(road::lane_type(network, at.road, location.lanes.lane_any_type, at.s_m))) return true;
  }
  return false;
}

/// Distance of a place from the nearest lane of these types outside of junctions; 1 if further than 0.3 m.
double distance_m(const road::RoadNetwork& network, const Vec2& p, const std::vector<road::LaneType>& types) {
  for (double reach_m = 0.0; reach_m <= 0.3; reach_m += 0.02)
    for (int i = 0; i < 12; ++i) {
      const double angle = i * 0.5236;
      for (const road::Location& location :
           road::roads_holding(network, p + reach_m * Vec2(std::cos(angle), std::sin(angle)))) {
        const road::RoadPosition& at = location.position;
        if (network.roads[at.road].junction == road::no_index &&
            std::ranges::find(types, road::lane_type(network, at.road, location.lanes.lane_any_type, at.s_m)) !=
                types.end())
          return reach_m;
      }
    }
  return 1.0;
}

}  // namespace

TEST_CASE("pavements go round every corner of the town's junctions, from one street's pavement to the next") {
  const road::RoadNetwork network = town();
  const std::vector<JunctionCorner> corners = junction_corners(network);
  std::size_t apart = 0, driven = 0;
  for (const JunctionCorner& corner : corners) {
    REQUIRE(corner.kerb_m.size() == corner.edge_m.size());
    for (const Vec3& end : {corner.kerb_m.front(), corner.kerb_m.back()})
      apart += distance_m(network, Vec2(end), {road::LaneType::sidewalk, road::LaneType::biking}) > 0.05;
    for (std::size_t i = 0; i < corner.kerb_m.size(); ++i)
      driven += is_driven(network, Vec2(glm::mix(corner.kerb_m[i], corner.edge_m[i], 0.05)));
  }
  CHECK(corners.size() > 200);
  CHECK(apart == 0);
  CHECK(driven == 0);
}

TEST_CASE("a corner's pavement is as high under wheels as it is drawn") {
  const road::RoadNetwork network = town();
  const RaisedAreas raised(network);
  REQUIRE(raised.corners().size() > 200);
  std::size_t wrong = 0;
  for (const JunctionCorner& corner : raised.corners()) {
    const std::size_t middle = corner.kerb_m.size() / 2;
    const Vec3 p = glm::mix(corner.kerb_m[middle], corner.edge_m[middle], 0.5);
    wrong += std::abs(raised.ground_at(Vec2(p), p.z - 0.12) - p.z) > 0.01;
  }
  CHECK(wrong == 0);
}

TEST_CASE("cars stand in a town's parking lanes, apart from each other and from lanes that are driven on") {
  const road::RoadNetwork network = town();
  const RoadShape roads(network, 0.0);
  const std::vector<ParkedCar> cars = parked_cars(roads, 7);
  CHECK(cars.size() > 300);
  int driven = 0, touching = 0;
  std::vector<Vec2> middles;
  for (const ParkedCar& car : cars) {
    const VehicleModel& model = vehicle_models()[car.model];
    for (const double x : {-model.rear_overhang_m, model.centre_x_m(), model.front_m()})
      for (const double y : {-0.5, 0.5})
        driven += is_driven(network, Vec2(car.world_from_vehicle * Vec3(x, y * model.width_m, 0.0)));
    middles.emplace_back(car.world_from_vehicle * Vec3(model.centre_x_m(), 0.0, 0.0));
  }
  for (std::size_t i = 0; i < middles.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) touching += glm::distance(middles[i], middles[k]) < 4.3;
  CHECK(driven == 0);
  CHECK(touching == 0);
  CHECK(parked_cars(roads, 8).front().world_from_vehicle.position_m != cars.front().world_from_vehicle.position_m);
}

TEST_CASE("benches, bins and boxes stand on a town's pavements, and lids lie in its lanes") {
  const road::RoadNetwork network = town();
  const std::vector<Furniture> things = street_furniture(RoadShape(network, 0.0), 7);
  CHECK(things.size() > 1500);
  std::vector<int> of_kind(furniture_kind_count);
  int driven = 0, off = 0;
  for (const Furniture& thing : things) {
    ++of_kind[static_cast<std::size_t>(thing.kind)];
    if (radius_of(thing.kind) <= 0.0) continue;
    const Vec2 p(thing.world_from_thing.position_m);
    driven += is_driven(network, p);
    off += distance_m(network, p, {road::LaneType::sidewalk}) > 0.0;
  }
  for (const int count : of_kind) CHECK(count > 20);
  CHECK(driven == 0);
  CHECK(off == 0);
}

TEST_CASE("the motorway has corners, parked cars and benches nowhere") {
  const road::RoadNetwork network = road::read_or_fail(shipped_text("scenarios/motorway-ambulance/motorway.xodr"));
  CHECK(junction_corners(network).empty());
  CHECK(parked_cars(RoadShape(network, 0.0), 7).empty());
  CHECK(street_furniture(RoadShape(network, 0.0), 7).empty());
}

}  // namespace septet::roadside
