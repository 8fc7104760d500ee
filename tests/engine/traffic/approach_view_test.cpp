#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/sight/air.hpp"
#include "engine/sight/walls.hpp"
#include "engine/traffic/network/approach_view.hpp"
#include "engine/traffic/network/town.hpp"
#include "engine/traffic/traffic_engine.hpp"
#include "tests/engine/traffic/crossing_cars.hpp"
#include "tests/engine/traffic/crossing_road.hpp"
#include "tests/engine/traffic/town_run.hpp"

namespace septet::traffic {
namespace {

constexpr double step_s = 1.0 / 30.0;
constexpr double never = -1.0;

/// A house as its four walls.
std::vector<sight::Wall> house(const Vec2& low_m, const Vec2& high_m) {
  const Vec2 a = low_m, b(high_m.x, low_m.y), c = high_m, d(low_m.x, high_m.y);
  return {{a, b, -1.0, 8.0}, {b, c, -1.0, 8.0}, {c, d, -1.0, 8.0}, {d, a, -1.0, 8.0}};
}

/// Between the arms of west and south, up to so far before the middle of the crossing.
sight::Walls house_beside_west(double from_middle_m) {
  return sight::Walls(house({-90.0, -90.0}, {-from_middle_m, -6.0}));
}

sight::Walls houses_at_all_corners() {
  std::vector<sight::Wall> walls;
  for (const double x : {-90.0, 9.0})
    for (const double y : {-90.0, 9.0})
      for (const sight::Wall& wall : house({x, y}, {x + 81.0, y + 81.0})) walls.push_back(wall);
  return sight::Walls(std::move(walls));
}

LaneGraph graph_with(const road::RoadNetwork& network, const sight::Walls& walls) {
  LaneGraph graph = build_lane_graph(network);
  look_past_walls(walls, graph);
  return graph;
}

/// From where on the way of a first connection those on a second one are in view.
double seen_from_m(const road::RoadNetwork& network, const LaneGraph& graph, const char* mine, const char* his) {
  const WayIndex with = way_of_road(network, graph, his, true);
  for (const WayConflict& conflict : graph.conflicts_of(graph.ways[way_of_road(network, graph, mine, true)]))
    if (conflict.with == with) return conflict.seen_from_m;
  return never;
}

/// A drive of the town's first car from its arm over the crossing.
struct Crossed {
  double slowest_mps = 1e300;     ///< Before the crossing.
  double most_needed_mps2 = 0.0;  ///< Braking that stopping at the line would have taken, while it was hidden.
  double line_mps = 0.0;          ///< As it passes the line.
  double opened_m = never;        ///< Before the line, as the view opened.
  double hidden_s = 0.0;
  std::vector<ParticipantId> order;  ///< Cars, as they come in.
};

Crossed cross(const LaneGraph& graph, const road::RoadNetwork& network, TownState town,
              std::vector<ForeignVehicle> foreign = {}, double seconds = 60.0) {
  Random random(1);
  Crossed crossed;
  const std::size_t cars = town.vehicles.size();
  for (double t = 0.0; t < seconds; t += step_s) {
    for (ForeignVehicle& other : foreign) other.world_from_vehicle.position_m += step_s * other.velocity_mps;
    advance_town(motorway_traffic(0, 1000.0), network, graph, {}, foreign, step_s, random, town);
    for (const ViewOpening& opening : town.openings)
      if (opening.driver == first_car_id) crossed.opened_m = opening.line_m, crossed.hidden_s = opening.hidden_s;
    for (const TownVehicle& car : town.vehicles) {
      if (car.outside) continue;
      const Way& way = graph.ways[car.route.front()];
      if (way.in_junction()) continue;
      const double line_m = way.length_m - way.line_before_m - car.front_m;
      const bool is_known = std::ranges::find(crossed.order, car.id) != crossed.order.end();
      if (car.front_m > way.length_m && !is_known) crossed.order.push_back(car.id);
      if (car.id != first_car_id || is_known) continue;
      crossed.slowest_mps = std::min(crossed.slowest_mps, car.speed_mps);
      if (line_m > 0.0) crossed.line_mps = car.speed_mps;
      if (car.hidden_s > 0.0)
        crossed.most_needed_mps2 = std::max(crossed.most_needed_mps2, 0.5 * car.speed_mps * car.speed_mps / line_m);
    }
    std::vector<Participant> shown;
    append_participants(graph, town, shown);
    for (std::size_t i = 0; i < shown.size(); ++i)
      for (std::size_t j = i + 1; j < shown.size(); ++j) CHECK_FALSE(outlines_overlap(shown[i], shown[j]));
  }
  CHECK(crossed.order.size() == cars);
  return crossed;
}

/// From west to east.
TownState car_from_west(const road::RoadNetwork& network, const LaneGraph& graph) {
  TownState town;
  add_car(network, graph, "west", "east", 100.0, town);
  return town;
}

}  // namespace

TEST_CASE("a house at the corner hides those from the right until its end, and those from the left not") {
  const road::RoadNetwork network = crossing(false, Posted::signs);
  const auto seen = [&](const sight::Walls& walls, const char* his) {
    return seen_from_m(network, graph_with(network, walls), "west-east", his);
  };
  const double always = std::numeric_limits<double>::infinity();
  CHECK(seen({}, "south-north") == always);
  CHECK(seen(house_beside_west(25.0), "south-north") == 10.0);
  CHECK(seen(house_beside_west(35.0), "south-north") == 20.0);
  CHECK(seen(house_beside_west(10.0), "south-north") == 0.0);
  CHECK(seen(house_beside_west(10.0), "north-south") == always);
  // Who has priority looks for nobody.
  CHECK(seen_from_m(network, graph_with(network, house_beside_west(10.0)), "south-north", "west-east") == always);
}

TEST_CASE("a driver comes to a hidden junction so that he can stop at its line, and to an open one at his speed") {
  const road::RoadNetwork network = crossing(false, Posted::signs);
  const LaneGraph open = graph_with(network, {}), at_line = graph_with(network, house_beside_west(10.0)),
                  at_10_m = graph_with(network, house_beside_west(25.0));
  const Crossed fast = cross(open, network, car_from_west(network, open));
  CHECK(fast.slowest_mps > 9.0);
  CHECK(fast.opened_m == never);
  const Crossed slow = cross(at_line, network, car_from_west(network, at_line));
  CHECK(slow.line_mps < 4.0);
  CHECK(slow.most_needed_mps2 > 1.0);
  CHECK(slow.most_needed_mps2 < 3.0);
  CHECK(slow.opened_m < 2.5);
  CHECK(slow.opened_m > 1.0);
  CHECK(slow.hidden_s > 2.0);
  const Crossed between = cross(at_10_m, network, car_from_west(network, at_10_m));
  CHECK(between.opened_m < 10.0);
  CHECK(between.opened_m > 9.5);
  CHECK(between.most_needed_mps2 < 3.0);
  CHECK(between.line_mps > slow.line_mps + 1.0);
  CHECK(between.line_mps < fast.line_mps - 1.0);
}

TEST_CASE("who has priority and is hidden until 10 m before the line is let pass") {
  const road::RoadNetwork network = crossing(false, Posted::signs);
  const LaneGraph graph = graph_with(network, house_beside_west(25.0));
  TownState town = car_from_west(network, graph);
  add_car(network, graph, "south", "north", 110.0, town);
  const Crossed crossed = cross(graph, network, town);
  CHECK(crossed.order == std::vector<ParticipantId>{first_car_id + 1, first_car_id});
  CHECK(crossed.opened_m > 9.5);
}

TEST_CASE("where a house ends a van parked at the corner still hides the junction, and a car does not") {
  const road::RoadNetwork network = crossing(false, Posted::signs);
  const LaneGraph graph = graph_with(network, house_beside_west(25.0));
  const auto opened_m = [&](const char* model) {
    ForeignVehicle parked;
    parked.model = find_vehicle_model(model).value();
    parked.world_from_vehicle.position_m = Vec3(-16.0, -5.2, 0.0);
    return cross(graph, network, car_from_west(network, graph), {parked}).opened_m;
  };
  CHECK(opened_m("van") < 2.5);
  CHECK(opened_m("van") > 0.0);
  CHECK(opened_m("volvo-s80") > 9.5);
}

TEST_CASE("a lorry that passes hides who comes behind it, and a car does not") {
  const road::RoadNetwork network = crossing(false, Posted::signs);
  const LaneGraph graph = graph_with(network, {});
  const auto hidden_s = [&](const char* model) {
    ForeignVehicle oncoming;
    oncoming.model = find_vehicle_model(model).value();
    oncoming.world_from_vehicle = {Vec3(-45.0, 1.75, 0.0), orientation_from_angles(std::numbers::pi, 0.0, 0.0)};
    oncoming.velocity_mps = Vec3(-4.0, 0.0, 0.0);
    return cross(graph, network, car_from_west(network, graph), {oncoming}).hidden_s;
  };
  CHECK(hidden_s("lorry") > 0.5);
  CHECK(hidden_s("volvo-s80") == 0.0);
}

TEST_CASE("who comes behind one that hides him on his own way is not looked for, unless that one stands") {
  const road::RoadNetwork network = crossing(false, Posted::signs);
  const LaneGraph graph = graph_with(network, {});
  const Way& his = graph.ways[way_of_road(network, graph, "south-north", true)];
  const Vec3 eyes_m(0.0, -8.0, 1.2);
  HighBody lorry{.who = 1, .moves = true, .box = {{Vec3(1.75, -30.0, 1.8)}, Vec3(1.25, 6.0, 1.8)}};
  CHECK_FALSE(is_hidden_by(std::span(&lorry, 1), {}, graph, eyes_m, his, 60.0));
  lorry.moves = false;
  CHECK(is_hidden_by(std::span(&lorry, 1), {}, graph, eyes_m, his, 60.0));
}

TEST_CASE("a driver goes through smoke, or fog, to a junction so that he can stop at its line") {
  const road::RoadNetwork network = crossing(false, Posted::signs);
  const LaneGraph graph = graph_with(network, {});
  const auto in_air = [&](sight::OpticalDepth air) {
    TownState town = car_from_west(network, graph);
    town.air = std::move(air);
    return cross(graph, network, std::move(town));
  };
  const auto fog = [](double per_m) {
    return [per_m](const Vec3& from_m, const Vec3& to_m) { return per_m * glm::distance(from_m, to_m); };
  };
  CHECK(in_air(fog(0.05)).hidden_s == 0.0);
  const Crossed thick = in_air(fog(0.5));
  CHECK(thick.hidden_s > 2.0);
  CHECK(thick.opened_m < 2.5);
  CHECK(thick.line_mps < 4.0);
  // A cloud over the arm of the south alone.
  const Crossed cloud =
      in_air([](const Vec3&, const Vec3& to_m) { return to_m.y < -15.0 ? sight::shining_depth + 1.0 : 0.0; });
  CHECK(cloud.opened_m < 2.5);
  CHECK(cloud.line_mps < 4.0);
}

TEST_CASE("a house that is taken away hides nobody, and hides again once it is back") {
  const road::RoadNetwork network = crossing(false, Posted::signs);
  std::vector<sight::Wall> walls = house({-90.0, -90.0}, {-10.0, -6.0});
  for (sight::Wall& wall : walls) wall.thing = 7;
  const sight::Walls house_7(std::move(walls));
  LaneGraph graph = graph_with(network, house_7);
  const std::uint32_t gone = 7;
  CHECK(seen_from_m(network, graph, "west-east", "south-north") == 0.0);
  look_past_walls(house_7, graph, std::span(&gone, 1));
  CHECK(seen_from_m(network, graph, "west-east", "south-north") == std::numeric_limits<double>::infinity());
  look_past_walls(house_7, graph);
  CHECK(seen_from_m(network, graph, "west-east", "south-north") == 0.0);
}

TEST_CASE("a swarm between houses comes to see its junction late, and not while the houses are taken away") {
  const road::RoadNetwork network = crossing(false, Posted::nothing);
  std::vector<sight::Wall> walls;
  for (const double x : {-90.0, 9.0})
    for (const double y : {-90.0, 9.0})
      for (sight::Wall wall : house({x, y}, {x + 81.0, y + 81.0})) wall.thing = 7, walls.push_back(wall);
  const sight::Walls houses(std::move(walls));
  ForeignVehicle far_away;
  far_away.world_from_vehicle.position_m = Vec3(0.0, 0.0, -50.0);
  const std::uint32_t house_7 = 7;
  // Openings within 20 s, in which the houses are away until some time.
  const auto openings = [&](double back_s) {
    const auto engine = own_traffic(network, 3);
    engine->see_walls(houses);
    engine->start(motorway_traffic(8, 1000.0), std::span(&far_away, 1));
    std::size_t count = 0;
    for (double t = 0.0; t < 20.0; t += step_s) {
      const std::span<const std::uint32_t> gone(&house_7, t < back_s ? 1 : 0);
      engine->limit_sight({.limited = {}, .air = {}, .gone = gone});
      engine->advance(std::span(&far_away, 1), step_s);
      count += engine->take_openings().size();
    }
    return count;
  };
  CHECK(openings(20.0) == 0);
  CHECK(openings(1.0) > 0);
  CHECK(openings(0.0) > 0);
}

TEST_CASE("between houses at all corners nobody waits for ever") {
  for (const Posted posted : {Posted::nothing, Posted::signs}) {
    const road::RoadNetwork network = crossing(false, posted);
    const LaneGraph graph = graph_with(network, houses_at_all_corners());
    TownState town;
    for (const double before_m : {50.0, 65.0, 80.0}) {
      add_car(network, graph, "south", "north", before_m, town);
      add_car(network, graph, "east", "south", before_m, town);
      add_car(network, graph, "north", "east", before_m, town);
      add_car(network, graph, "west", "east", before_m, town);
    }
    cross(graph, network, town, {}, 180.0);
  }
}

}  // namespace septet::traffic
