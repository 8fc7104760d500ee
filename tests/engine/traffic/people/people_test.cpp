#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>

#include "engine/traffic/network/town.hpp"
#include "engine/world/vehicle_model.hpp"
#include "tests/engine/traffic/people/people_run.hpp"
#include "tests/engine/traffic/people/street.hpp"
#include "tests/shipped_files.hpp"

namespace septet::traffic {
namespace {

/// Somebody at a place of a walk, alone.
Person person_on(const WalkwayGraph& graph, WalkIndex walk, double at_m, bool forwards, double beside_m = -0.5) {
  Person person;
  person.id = first_person_participant;
  person.outside = false;
  person.walk = walk, person.forwards = forwards, person.at_m = at_m, person.beside_m = beside_m;
  const PlaceOnWalk place = place_on_walk(graph, graph.walks[walk], at_m);
  const Vec2 along = forwards ? place.along : -place.along;
  person.position_m = Vec2(place.middle_m) + beside_m * Vec2(-along.y, along.x);
  person.heading_rad = std::atan2(along.y, along.x);
  return person;
}

void add(Person person, PeopleState& people) {
  person.id = first_person_participant + static_cast<ParticipantId>(people.people.size());
  person.leader = static_cast<std::uint32_t>(people.people.size());
  people.people.push_back(person);
}

WalkIndex crossing_walk(const WalkwayGraph& graph) { return graph.crossings.front().walk; }

/// A car that comes along the lane towards increasing x.
Participant car_at(double front_x_m, double speed_mps) {
  Participant car;
  car.id = 1;
  car.model = *find_vehicle_model("saloon");
  car.world_from_vehicle = {Vec3(front_x_m - vehicle_models()[car.model].front_m(), -1.75, 0.0), Quat(1, 0, 0, 0)};
  car.velocity_mps = Vec3(speed_mps, 0.0, 0.0);
  return car;
}

/// Time until he who comes to the crosswalk from its left pavement is on the road; infinite: not within `limit_s`.
double steps_out_s(const WalkwayGraph& graph, PeopleAround around, double limit_s, const BeforeTick& before) {
  PeopleState people;
  add(person_on(graph, crossing_walk(graph), 0.1, true), people);
  double t_s = 0.0, out_s = INFINITY;
  run_people(graph, {1, 1000.0}, around, limit_s, people, [&](const PeopleState& now, PeopleAround& around_now) {
    before(now, around_now);
    t_s += 1.0 / 120.0;
    if (now.people.front().position_m.y < kerb_t_m - 0.1) out_s = std::min(out_s, t_s);
  });
  return out_s;
}

}  // namespace

TEST_CASE("a street's pavements and its crosswalk are walks that meet at nodes, 0.12 m above the lanes") {
  const WalkwayGraph graph = walkways(street());
  REQUIRE(graph.crossings.size() == 1);
  CHECK(graph.walks.size() == 5);  // Two pavements, parted at the crosswalk, and that.
  CHECK(graph.nodes.size() == 6);
  const Walk& crossing = graph.walks[crossing_walk(graph)];
  CHECK(graph.ends_of(graph.nodes[crossing.begin]).size() == 3);
  CHECK(graph.ends_of(graph.nodes[crossing.end]).size() == 3);
  CHECK(crossing.length_m == doctest::Approx(2.0 * kerb_t_m + street_pavement_m));
  CHECK(place_on_walk(graph, crossing, 0.0).middle_m.z == doctest::Approx(0.12));
  CHECK(place_on_walk(graph, crossing, 0.5 * crossing.length_m).middle_m.z == doctest::Approx(0.0));
  CHECK(graph.crossings.front().left_kerb_m.y == doctest::Approx(kerb_t_m));
  CHECK(graph.crossings.front().kind == Crossing::Kind::zebra);
}

TEST_CASE("the pavements of the shipped town lead round its corners, and nearly all of them are one") {
  const auto network = road::read_opendrive(shipped_text("scenarios/town/town.xodr"), "town.xodr");
  REQUIRE(network.has_value());
  const WalkwayGraph graph = walkways(*network);
  std::vector<bool> reached(graph.nodes.size(), false);
  std::vector<NodeIndex> open{graph.walks.front().begin};
  reached[open.front()] = true;
  while (!open.empty()) {
    const NodeIndex node = open.back();
    open.pop_back();
    for (const WalkEnd& end : graph.ends_of(graph.nodes[node])) {
      const NodeIndex other = end.is_begin ? graph.walks[end.walk].end : graph.walks[end.walk].begin;
      if (!reached[other]) reached[other] = true, open.push_back(other);
    }
  }
  const auto share = static_cast<double>(std::ranges::count(reached, true)) / static_cast<double>(reached.size());
  CHECK(share > 0.9);
}

TEST_CASE("two who meet on a pavement pass each other on the right, and on the left where people keep left") {
  const WalkwayGraph graph = walkways(street(false));
  for (const bool keeps_left : {false, true}) {
    CAPTURE(keeps_left);
    PeopleState people;
    add(person_on(graph, 0, 80.0, true, 0.0), people);
    add(person_on(graph, 0, 95.0, false, 0.0), people);
    for (Person& person : people.people) person.beside_m = -0.4;
    PeopleAround around;
    around.keeps_left = keeps_left;
    double aside_m = 0.0;
    const PeopleRun run = run_people(graph, {2, 1000.0}, around, 12.0, people, [&](const PeopleState& now, auto&) {
      const Vec2 apart = now.people[1].position_m - now.people[0].position_m;
      if (std::abs(apart.x) < 0.1) {
        const Vec2 ahead(std::cos(now.people[0].heading_rad), std::sin(now.people[0].heading_rad));
        aside_m = ahead.x * apart.y - ahead.y * apart.x;
      }
    });
    CHECK(run.nearest_m >= apart_m - 1e-9);
    CHECK((keeps_left ? -aside_m : aside_m) > 0.7);
    CHECK(glm::distance(people.people[0].position_m, people.people[1].position_m) > 8.0);
  }
}

TEST_CASE("at a crosswalk people let a car pass that cannot stop gently, and go before one that can") {
  const WalkwayGraph graph = walkways(street());
  const double band_m = crosswalk_s_m - 2.0;
  std::vector<Participant> cars(1);
  // It passes with 14 m/s, 30 m before the crosswalk as the other comes to the kerb; its rear is over it 2.8 s later.
  double t_s = 0.0;
  const double alone_s = steps_out_s(graph, {}, 10.0, [](auto&, auto&) {});
  CHECK(alone_s < 3.0);
  const double behind_s = steps_out_s(graph, {}, 20.0, [&](auto&, PeopleAround& around) {
    cars[0] = car_at(band_m - 38.0 + 14.0 * t_s, 14.0);
    around.vehicles = cars;
    t_s += 1.0 / 120.0;
  });
  CHECK(behind_s > 38.0 / 14.0);
  CHECK(behind_s < 6.0);
  // One that rolls 30 m before it with 5 m/s could stop with 0.4 m/s².
  const double before_s = steps_out_s(graph, {}, 20.0, [&](auto&, PeopleAround& around) {
    cars[0] = car_at(band_m - 30.0, 5.0);
    around.vehicles = cars;
  });
  CHECK(std::abs(before_s - alone_s) < 0.1);
}

TEST_CASE("people cross at their green light alone") {
  const road::RoadNetwork network = street();
  WalkwaySurroundings surroundings;
  TrafficLight head;
  head.s_m = crosswalk_s_m - 2.4;
  head.for_walkers = true;
  surroundings.lights = {head};
  const WalkwayGraph graph = build_walkways(network, surroundings);
  REQUIRE(graph.crossings.front().kind == Crossing::Kind::light);
  std::vector<TrafficLight> lights{head};
  double t_s = 0.0;
  const double out_s = steps_out_s(graph, {}, 20.0, [&](auto&, PeopleAround& around) {
    lights[0].lamps = {};
    lights[0].lamps.set(t_s > 8.0 ? Lamp::signal_green : Lamp::signal_red, true);
    around.lights = lights;
    t_s += 1.0 / 120.0;
  });
  CHECK(out_s > 8.0);
  CHECK(out_s < 11.0);
}

TEST_CASE("traffic stops before a crosswalk for who waits or walks there, and goes on once he has passed its lane") {
  const road::RoadNetwork network = street();
  const WalkwayGraph walks = walkways(network);
  LaneGraph graph = build_lane_graph(network);
  mark_crossings(network, std::vector{walks.crossings.front().place}, graph);
  const WayIndex way = way_at(graph, network, 0, -1, 50.0);
  REQUIRE(graph.walked_of(graph.ways[way]).size() == 1);
  const TrafficParameters parameters = motorway_traffic(0, 1000.0);
  const auto front_after_m = [&](const std::vector<PersonCrossing>& people) {
    TownState town;
    TownVehicle& car = town.vehicles.emplace_back();
    car.id = 1000;
    car.model = *find_vehicle_model("saloon");
    car.driver = driver_in_town(parameters.classes.front().middle, 0.5);
    car.law = FollowingLaw(car.driver.following);
    car.outside = false;
    car.route = {way};
    car.front_m = 40.0, car.speed_mps = 12.0;
    town.people = people;
    Random random(1);
    for (int k = 0; k < 300; ++k) advance_town(parameters, network, graph, {}, {}, 1.0 / 30.0, random, town);
    return town.vehicles.front().front_m;
  };
  CHECK(front_after_m({}) > crosswalk_s_m + 20.0);
  const double waits_m = front_after_m({{0, -0.5, 1.34, true}});
  CHECK(waits_m > crosswalk_s_m - 8.0);
  CHECK(waits_m < crosswalk_s_m - 2.0 - 0.9);
  CHECK(front_after_m({{0, 5.0, 1.34, false}}) < crosswalk_s_m - 2.0);
  // The lane of the car lies to the right: who goes to the left is out of it.
  CHECK(front_after_m({{0, 2.0, -1.34, false}}) > crosswalk_s_m + 20.0);
}

TEST_CASE("people come in where the driver does not see it") {
  const WalkwayGraph graph = walkways(street());
  PeopleAround around;
  around.driver_eyes_m = Vec3(-40.0, 0.0, 1.2);
  const PeopleWish wish{30, 250.0};
  PeopleState people = populate_people(wish, graph, around, 3);
  std::vector<Person> before = people.people;
  std::uint32_t came = 0;
  run_people(graph, wish, around, 60.0, people, [&](const PeopleState& now, PeopleAround& around_now) {
    for (std::size_t k = 0; k < before.size(); ++k) {
      const Person& person = now.people[k];
      const bool comes =
          !person.outside && (before[k].outside || glm::distance(before[k].position_m, person.position_m) > 1.0);
      if (!comes) continue;
      ++came;
      CHECK(glm::distance(person.position_m, Vec2(around_now.driver_eyes_m)) > 149.0);
    }
    before = now.people;
    around_now.driver_eyes_m.x -= 1.5 / 120.0;
  });
  CHECK(came > 0);
}

TEST_CASE("who is taken off his rails leaves the rest of his group together") {
  PeopleState people;
  for (ParticipantId k = 0; k < 5; ++k) {
    Person& person = people.people.emplace_back();
    person.id = first_person_participant + k;
    person.leader = k < 2 ? k : 2;  // Two alone, three together.
  }
  REQUIRE(release(first_person_participant + 2, people));
  CHECK_FALSE(release(first_person_participant + 2, people));
  REQUIRE(people.people.size() == 4);
  CHECK(people.people[1].leader == 1);
  CHECK(people.people[2].leader == 2);
  CHECK(people.people[3].leader == 2);
}

}  // namespace septet::traffic
