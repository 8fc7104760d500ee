#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/core/archive.hpp"
#include "engine/road/opendrive_reader.hpp"
#include "engine/traffic/network/town.hpp"
#include "engine/traffic/traffic_engine.hpp"
#include "tests/conformance/conformance_data.hpp"
#include "tests/engine/traffic/crossing_cars.hpp"
#include "tests/engine/traffic/crossing_road.hpp"
#include "tests/engine/traffic/public_town.hpp"
#include "tests/engine/traffic/town_run.hpp"
#include "tests/shipped_files.hpp"

namespace septet::traffic {
namespace {

constexpr double dt_s = 1.0 / 30.0;

/// Names of the arms in the order in which their cars come to the crossing's inside.
std::vector<std::string> order_of_entry(const road::RoadNetwork& network, const LaneGraph& graph, TownState town,
                                        const std::vector<TrafficLight>& lights = {}, double seconds = 40.0) {
  const TrafficParameters parameters = motorway_traffic(0, 1000.0);
  Random random(1);
  std::vector<std::string> order;
  std::vector<std::string> arms;
  arms.reserve(town.vehicles.size());
  for (const TownVehicle& car : town.vehicles) arms.push_back(network.roads[graph.ways[car.route.front()].road].id);
  for (double t = 0.0; t < seconds; t += dt_s) {
    advance_town(parameters, network, graph, lights, {}, dt_s, random, town);
    std::vector<Participant> shown;
    append_participants(graph, town, shown);
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const bool is_inside = glm::length(Vec2(shown[i].world_from_vehicle.position_m)) < arm_end_m - 1.0;
      const std::string& arm = arms[shown[i].id - first_car_id];
      if (is_inside && std::ranges::find(order, arm) == order.end()) order.push_back(arm);
      for (std::size_t j = i + 1; j < shown.size(); ++j) CHECK_FALSE(outlines_overlap(shown[i], shown[j]));
    }
  }
  return order;
}

using Order = std::vector<std::string>;

}  // namespace

TEST_CASE("at a crossing without signs right goes before left, and left before right where traffic keeps left") {
  for (const bool left_hand : {false, true}) {
    CAPTURE(left_hand);
    const road::RoadNetwork network = crossing(left_hand);
    const LaneGraph graph = build_lane_graph(network);
    TownState town;
    add_car(network, graph, "south", "north", 60.0, town);
    add_car(network, graph, "east", "west", 60.0, town);
    CHECK(order_of_entry(network, graph, town) == (left_hand ? Order{"south", "east"} : Order{"east", "south"}));
  }
}

TEST_CASE("who turns across the oncoming lets them pass") {
  const road::RoadNetwork network = crossing();
  const LaneGraph graph = build_lane_graph(network);
  TownState town;
  add_car(network, graph, "south", "west", 60.0, town);
  add_car(network, graph, "north", "south", 70.0, town);
  CHECK(order_of_entry(network, graph, town) == Order{"north", "south"});
}

TEST_CASE("a give-way sign stops him who would come from the right") {
  const road::RoadNetwork network = crossing(false, Posted::signs);
  const LaneGraph graph = build_lane_graph(network);
  TownState town;
  add_car(network, graph, "south", "north", 70.0, town);
  add_car(network, graph, "east", "west", 60.0, town);
  CHECK(order_of_entry(network, graph, town) == Order{"south", "east"});
}

TEST_CASE("nobody passes a red light, and who has green goes") {
  const road::RoadNetwork network = crossing(false, Posted::lights);
  const LaneGraph graph = build_lane_graph(network);
  TownState town;
  add_car(network, graph, "south", "north", 60.0, town);
  add_car(network, graph, "east", "west", 60.0, town);
  const auto light = [&](const char* arm, Lamp lamp) {
    TrafficLight head;
    head.road = *road::find_road(network, arm);
    head.lamps.set(lamp, true);
    return head;
  };
  // East comes from the right of south.
  const std::vector<TrafficLight> lights{light("south", Lamp::signal_green), light("east", Lamp::signal_red),
                                         light("north", Lamp::signal_green), light("west", Lamp::signal_red)};
  CHECK(order_of_entry(network, graph, town, lights) == Order{"south"});
}

TEST_CASE(
    "who has claimed a crossing at green stops at its line if the light turns while he still can, and else goes on") {
  const road::RoadNetwork network = crossing(false, Posted::lights);
  const LaneGraph graph = build_lane_graph(network);
  // Lights turn to amber after a second, to red after three more; 13 m/s could be stopped from by 3 m/s² within 28 m.
  const auto passes = [&](double before_m) {
    TownState town;
    add_car(network, graph, "south", "north", before_m, town);
    town.vehicles.front().speed_mps = 13.0;
    TrafficLight head;
    head.road = *road::find_road(network, "south");
    std::vector<TrafficLight> lights{head};
    const TrafficParameters parameters = motorway_traffic(0, 1000.0);
    Random random(1);
    for (double t = 0.0; t < 12.0; t += dt_s) {
      lights.front().lamps = {};
      lights.front().lamps.set(t < 1.0 ? Lamp::signal_green : t < 4.0 ? Lamp::signal_amber : Lamp::signal_red, true);
      advance_town(parameters, network, graph, lights, {}, dt_s, random, town);
      if (t < 0.9) CHECK(town.vehicles.front().acceleration_mps2 > -1.0);
      CHECK(town.vehicles.front().acceleration_mps2 > -3.6);
    }
    const TownVehicle& car = town.vehicles.front();
    return graph.ways[car.route.front()].in_junction() || car.front_m > graph.ways[car.route.front()].length_m ||
           network.roads[graph.ways[car.route.front()].road].id == "north";
  };
  CHECK_FALSE(passes(55.0));
  CHECK(passes(30.0));
}

TEST_CASE("four who each have one on their right all get across") {
  const road::RoadNetwork network = crossing();
  const LaneGraph graph = build_lane_graph(network);
  TownState town;
  add_car(network, graph, "south", "north", 60.0, town);
  add_car(network, graph, "east", "west", 60.0, town);
  add_car(network, graph, "north", "south", 60.0, town);
  add_car(network, graph, "west", "east", 60.0, town);
  CHECK(order_of_entry(network, graph, town).size() == 4);
}

TEST_CASE("nobody enters a junction whose exit is full") {
  const road::RoadNetwork network = crossing();
  const LaneGraph graph = build_lane_graph(network);
  TownState town;
  add_car(network, graph, "south", "north", 60.0, town);
  // One stands 3 m beyond the crossing and does not move.
  const Way& exit = graph.ways[way_of_road(network, graph, "north", false)];
  const PlaceOnWay place = place_on_way(graph, exit, 4.5);
  ForeignVehicle standing;
  standing.model = motorway_traffic(1, 1.0).classes.front().model;
  standing.world_from_vehicle = {place.position_m, orientation_from_angles(0.5 * std::numbers::pi, 0.0, 0.0)};
  const TrafficParameters parameters = motorway_traffic(0, 1000.0);
  Random random(1);
  // Later on it would choose another exit.
  for (double t = 0.0; t < 11.0; t += dt_s)
    advance_town(parameters, network, graph, {}, std::span(&standing, 1), dt_s, random, town);
  REQUIRE(town.vehicles.size() == 1);
  CHECK(town.vehicles.front().speed_mps == 0.0);
  CHECK(town.vehicles.front().route.size() == 3);
  CHECK(town.vehicles.front().front_m < graph.ways[town.vehicles.front().route.front()].length_m);
}

TEST_CASE("nobody drives into a car that stands in the middle of a crossing") {
  const road::RoadNetwork network = crossing();
  const LaneGraph graph = build_lane_graph(network);
  TownState town;
  add_car(network, graph, "south", "north", 60.0, town);
  add_car(network, graph, "east", "west", 90.0, town);
  ForeignVehicle standing;
  standing.model = motorway_traffic(1, 1.0).classes.front().model;
  standing.world_from_vehicle = {Vec3(1.0, -0.5, 0.0), orientation_from_angles(0.8, 0.0, 0.0)};
  Participant body;
  body.model = standing.model;
  body.world_from_vehicle = standing.world_from_vehicle;
  const TrafficParameters parameters = motorway_traffic(0, 1000.0);
  Random random(1);
  for (double t = 0.0; t < 30.0; t += dt_s) {
    advance_town(parameters, network, graph, {}, std::span(&standing, 1), dt_s, random, town);
    std::vector<Participant> shown;
    append_participants(graph, town, shown);
    for (const Participant& car : shown) CHECK_FALSE(outlines_overlap(car, body));
  }
}

TEST_CASE("vehicles drive all of a public town's roads, more of them than on any line, and none overlaps another") {
  const road::RoadNetwork network = public_town("Town01");
  const LaneGraph graph = build_lane_graph(network);
  const TownRun run = run_town(network, graph, motorway_traffic(60, 2000.0), 240.0, 3, dt_s);
  CHECK(run.overlaps.empty());
  CHECK(run.least_there == 60);
  CHECK(run.roads.size() > 60);
  CHECK(run.mean_mps() > 3.0);
  CHECK(run.most_sideways_mps2 < most_bend_mps2);
}

TEST_CASE("a town's traffic goes on from its saved state as if it had not been saved") {
  const road::RoadNetwork network = public_town("Town01");
  const auto engine = own_traffic(network, 5);
  ForeignVehicle driver;
  driver.model = *find_vehicle_model("volvo-s80");
  driver.world_from_vehicle.position_m = Vec3(0.5 * (network.low_m + network.high_m), 0.0);
  const std::span<const ForeignVehicle> foreign(&driver, 1);
  engine->start(motorway_traffic(40, 2000.0), foreign);
  for (int k = 0; k < 600; ++k) engine->advance(foreign, dt_s);
  Bytes bytes;
  StateWriter writer(bytes);
  engine->save(writer);
  const auto again = own_traffic(network, 5);
  StateReader reader(bytes);
  again->restore(reader);
  REQUIRE(reader.ok());
  CHECK(reader.remaining() == 0);
  for (int k = 0; k < 600; ++k) engine->advance(foreign, dt_s), again->advance(foreign, dt_s);
  StateHash a, b;
  engine->add_to_hash(a);
  again->add_to_hash(b);
  CHECK(a.value() == b.value());
}

TEST_CASE("nobody is placed where his lane is narrower than he is, as where it opens") {
  const auto path = conformance_data("roads") / "multi_intersections.xodr";
  const auto network = road::read_opendrive(text_of(path), path.string());
  REQUIRE(network.has_value());
  const LaneGraph graph = build_lane_graph(*network);
  std::size_t on_opening = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Random random(seed, 1);
    const TownState town = populate_town(motorway_traffic(150, 3000.0), *network, graph, {}, random);
    for (const TownVehicle& vehicle : town.vehicles) {
      if (vehicle.outside) continue;
      const Way& way = graph.ways[vehicle.route.front()];
      // Lane 1 of this road has no width from 59 m on, against its traffic.
      on_opening += network->roads[way.road].id == "202" && way.lane == 1 ? 1 : 0;
      for (double back_m = 0.0; back_m <= vehicle.length_m(); back_m += 0.5)
        CHECK(place_on_way(graph, way, vehicle.front_m - back_m).width_m >=
              vehicle_models()[vehicle.model].width_m - 0.01);
    }
  }
  CHECK(on_opening > 0);
}

TEST_CASE("nobody is placed in anybody, where lanes lie nearer to each other than cars are wide as well") {
  const auto path = conformance_data("roads") / "multi_intersections.xodr";
  const auto network = road::read_opendrive(text_of(path), path.string());
  REQUIRE(network.has_value());
  const LaneGraph graph = build_lane_graph(*network);
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    CAPTURE(seed);
    Random random(seed, 1);
    const TownState town = populate_town(motorway_traffic(150, 3000.0), *network, graph, {}, random);
    std::vector<Participant> placed;
    append_participants(graph, town, placed);
    for (std::size_t i = 0; i < placed.size(); ++i)
      for (std::size_t j = i + 1; j < placed.size(); ++j) CHECK_FALSE(outlines_overlap(placed[i], placed[j]));
  }
}

}  // namespace septet::traffic
