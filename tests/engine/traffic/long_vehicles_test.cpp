#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/engine/traffic/crossing_cars.hpp"
#include "tests/engine/traffic/crossing_road.hpp"
#include "tests/engine/traffic/town_run.hpp"

namespace septet::traffic {
namespace {

ModelIndex lorry_model() {
  const auto model = find_vehicle_model("lorry");
  REQUIRE(model.has_value());
  return *model;
}

struct Passing {
  bool touch = false;
  std::size_t across = 0;  ///< How many have got to the other side.
};

/// A lorry that turns right out of the south, and somebody who comes from the east, turns left and so drives beside it.
Passing pass_in_turns(const road::RoadNetwork& network, const LaneGraph& graph, double other_before_m,
                      bool other_is_lorry) {
  TownState town;
  add_car(network, graph, "south", "east", 60.0, town);
  add_car(network, graph, "east", "south", other_before_m, town);
  town.vehicles[0].model = lorry_model();
  if (other_is_lorry) town.vehicles[1].model = lorry_model();
  const TrafficParameters parameters = motorway_traffic(0, 1000.0);
  Random random(1);
  Passing passing;
  std::set<ParticipantId> across;
  for (double t = 0.0; t < 30.0; t += 1.0 / 30.0) {
    advance_town(parameters, network, graph, {}, {}, 1.0 / 30.0, random, town);
    std::vector<Participant> shown;
    append_participants(graph, town, shown);
    for (std::size_t i = 0; i < shown.size(); ++i)
      for (std::size_t j = i + 1; j < shown.size(); ++j)
        passing.touch = passing.touch || outlines_overlap(shown[i], shown[j]);
    for (const TownVehicle& vehicle : town.vehicles)
      if (!vehicle.outside && !graph.ways[vehicle.route.front()].along_s) across.insert(vehicle.id);
  }
  passing.across = across.size();
  return passing;
}

}  // namespace

TEST_CASE("a lorry in a turn reaches over its lane's middle as far to the inside as to the outside, and no farther") {
  const road::RoadNetwork network = crossing();
  const LaneGraph graph = build_lane_graph(network);
  TownState town;
  add_car(network, graph, "south", "east", 60.0, town);
  TownVehicle& lorry = town.vehicles.front();
  lorry.model = lorry_model();
  const VehicleModel& model = vehicle_models()[lorry.model];
  const Way& turn = graph.ways[lorry.route[1]];
  lorry.front_m = graph.ways[lorry.route[0]].length_m + 0.5 * turn.length_m + 0.5 * model.length_m;
  std::vector<Participant> shown;
  append_participants(graph, town, shown);
  REQUIRE(shown.size() == 1);
  const Vec3 circle_m(arm_end_m, -arm_end_m, 0.0);
  const auto from_circle_m = [&](double x, double y) {
    return glm::distance(shown.front().world_from_vehicle * Vec3(x, y, 0.0), circle_m);
  };
  // It turns right: its left side is the outer one.
  const double half_m = 0.5 * model.width_m;
  const double outer_m =
      std::max(from_circle_m(-model.rear_overhang_m, half_m), from_circle_m(model.front_m(), half_m));
  const double inner_m = from_circle_m(model.centre_x_m(), -half_m);
  const double most_m = half_m + longest_rigid_m * longest_rigid_m / (16.0 * right_turn_m);
  CHECK(outer_m - right_turn_m < most_m);
  CHECK(right_turn_m - inner_m < most_m);
  CHECK(std::abs((outer_m - right_turn_m) - (right_turn_m - inner_m)) < 0.3);
}

TEST_CASE("nobody who comes out of the street into which a lorry turns is touched by it, another lorry neither") {
  const road::RoadNetwork network = crossing();
  const LaneGraph graph = build_lane_graph(network);
  for (const bool other_is_lorry : {false, true})
    for (double before_m = 30.0; before_m <= 90.0; before_m += 3.0) {
      CAPTURE(other_is_lorry);
      CAPTURE(before_m);
      const Passing passing = pass_in_turns(network, graph, before_m, other_is_lorry);
      CHECK_FALSE(passing.touch);
      CHECK(passing.across == 2);
    }
}

TEST_CASE("long vehicles do not meet in turns beside each other, and pass where both go straight on") {
  const road::RoadNetwork network = crossing();
  const LaneGraph graph = build_lane_graph(network);
  const auto excludes = [&](const char* a, const char* b) {
    const auto beside = graph.long_conflicts_of(graph.ways[way_of_road(network, graph, a, true)]);
    return std::ranges::find(beside, way_of_road(network, graph, b, true)) != beside.end();
  };
  CHECK(excludes("south-east", "east-south"));
  CHECK(excludes("east-south", "south-east"));
  CHECK_FALSE(excludes("south-north", "north-south"));
  // Those meet as any two do.
  CHECK_FALSE(excludes("south-north", "east-west"));
}

}  // namespace septet::traffic
