#include "sim-server/sumo/sumo_traffic.hpp"

#include <cmath>
#include <map>
#include <set>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/engine/road/road_files.hpp"
#include "tests/engine/traffic/ring_road.hpp"
#include "tests/relative.hpp"

namespace septet::server {
namespace {

/// A SUMO in which everybody departs at once and drives straight on along +x from where it was set out, at 20 m/s.
class StraightSumo final : public SumoClient {
 public:
  std::map<ParticipantId, SumoVehicle> vehicles;
  std::map<ParticipantId, Vec2> foreign;
  std::set<ParticipantId> held;
  std::map<ParticipantId, double> standstill_gap_m, asked_aside_m;
  int steps = 0, steps_until_gone = 1000;
  ParticipantId refused_from = 1'000'000;  ///< From this id on vehicles find no room.
  int refusals = 0;

  Expected<void> define_type(const SumoVehicleType&) override { return {}; }
  Expected<void> add_vehicle(const SumoDeparture& departure) override {
    if (departure.id >= refused_from) {
      ++refusals;
      return {};
    }
    if (departure.watched)
      vehicles[departure.id] = {departure.id, {departure.along_m, -2.0}, 0.0, 20.0, 0.0, sumo_signal::brake_light};
    return {};
  }
  Expected<void> remove_vehicle(ParticipantId id) override {
    vehicles.erase(id);
    return {};
  }
  Expected<void> place_vehicle(ParticipantId id, const Vec2& front_m, double) override {
    foreign[id] = front_m;
    return {};
  }
  Expected<void> set_standstill_gap(ParticipantId id, double gap_m) override {
    standstill_gap_m[id] = gap_m;
    return {};
  }
  Expected<void> hold_vehicle(ParticipantId id, bool is_held) override {
    if (is_held) held.insert(id);
    if (!is_held) held.erase(id);
    return {};
  }
  Expected<void> move_aside(ParticipantId id, double left_m) override {
    asked_aside_m[id] = left_m;
    return {};
  }
  Expected<std::vector<SumoVehicle>> step() override {
    if (++steps > steps_until_gone) return failure("SUMO has gone: closed", "--traffic sumo", "start again");
    std::vector<SumoVehicle> seen;
    for (auto& [id, vehicle] : vehicles) {
      vehicle.front_m.x += vehicle.speed_mps * sumo_step_s;
      seen.push_back(vehicle);
    }
    return seen;
  }
};

road::RoadNetwork straight_road() {
  return road::read_or_fail(
      road::SmallRoad{.length_m = 5000.0, .sections = road::lane_section("", road::lane(-1, 4.0))}.xml());
}

struct Scene {
  road::RoadNetwork roads = straight_road();
  std::shared_ptr<StraightSumo> sumo = std::make_shared<StraightSumo>();
  SumoTraffic traffic{roads, make_sumo_network(roads), sumo, 1};
  std::vector<traffic::ForeignVehicle> foreign{1};

  explicit Scene(ParticipantId refused_from = 1'000'000) {
    sumo->refused_from = refused_from;
    foreign[0].id = 1;
    foreign[0].world_from_vehicle.position_m = {2500.0, -2.0, 0.0};
    foreign[0].velocity_mps = {20.0, 0.0, 0.0};
    traffic.start(traffic::motorway_traffic(10, 1000.0), foreign);
  }
  std::vector<Participant> tick() {
    traffic.advance(foreign, 1.0 / 120.0);
    std::vector<Participant> participants;
    traffic.append_participants(participants);
    return participants;
  }
};

}  // namespace

TEST_CASE("between the steps of SUMO every tick is where the speed says") {
  Scene scene;
  auto before = scene.tick();
  REQUIRE(before.size() == 10);
  for (int tick = 0; tick < 120; ++tick) {
    const auto now = scene.tick();
    REQUIRE(now.size() == before.size());
    for (std::size_t i = 0; i < now.size(); ++i) {
      CHECK(now[i].id == before[i].id);
      CHECK(now[i].world_from_vehicle.position_m.x - before[i].world_from_vehicle.position_m.x ==
            relative(20.0 / 120.0, 1e-6));
      CHECK(now[i].velocity_mps.x == doctest::Approx(20.0));
      CHECK(now[i].lamps.has(Lamp::brake));
    }
    before = now;
  }
  // Twenty steps of SUMO a second, two of them before the drive begins.
  CHECK(scene.sumo->steps == 2 + 20);
}

TEST_CASE("whom SUMO never sets out is asked for elsewhere, left out, counted and told once; the drive goes on") {
  for (const ParticipantId refused_from : {1000u, 1003u, 1008u, 1009u, 1010u}) {
    Scene scene(refused_from);
    std::optional<std::string> said;
    int remarks = 0;
    for (int tick = 0; tick < 240; ++tick) {
      scene.tick();
      REQUIRE_FALSE(scene.traffic.take_error());
      if (auto remark = scene.traffic.take_remark()) said = std::move(remark), ++remarks;
    }
    const std::size_t there = refused_from - 1000;
    CHECK(remarks == (there == 10 ? 0 : 1));
    if (there < 10) CHECK(said == fmt::format("asked=10 on_road={}", there));
    if (there < 10) CHECK(scene.sumo->refusals > static_cast<int>(10 - there));
    CHECK(scene.tick().size() == there);
  }
}

TEST_CASE("SUMO is told where the vehicles of others will be at its next step") {
  Scene scene;
  scene.tick();
  const double front = vehicle_models()[0].front_m();
  REQUIRE(scene.sumo->foreign.contains(1));
  CHECK(scene.sumo->foreign[1].x == doctest::Approx(2500.0 + front + 20.0 * sumo_step_s));
  CHECK(scene.sumo->foreign[1].y == doctest::Approx(-2.0));
}

TEST_CASE("a vehicle that SUMO gives up comes back to it as one of others, once its number is free") {
  Scene scene;
  auto before = scene.tick();
  const Participant hit = before.at(4);
  REQUIRE(scene.traffic.release(hit.id));
  CHECK_FALSE(scene.traffic.release(hit.id));
  CHECK_FALSE(scene.sumo->vehicles.contains(hit.id));
  scene.foreign.push_back({hit.id, hit.model, hit.world_from_vehicle, {}, {}, true});
  const int steps = scene.sumo->steps;
  while (scene.sumo->steps == steps) {
    CHECK_FALSE(scene.sumo->foreign.contains(hit.id));
    for (const Participant& one : scene.tick()) CHECK(one.id != hit.id);
  }
  for (int tick = 0; tick < 12; ++tick) scene.tick();
  CHECK(scene.sumo->foreign.contains(hit.id));
  CHECK(scene.tick().size() == 9);
}

TEST_CASE("a SUMO that goes away is one error and the traffic stands still from then on") {
  Scene scene;
  scene.sumo->steps_until_gone = 10;
  std::optional<Error> error;
  int tick = 0;
  for (; tick < 120 && !error; ++tick) {
    scene.tick();
    error = scene.traffic.take_error();
  }
  REQUIRE(error.has_value());
  CHECK(error->what.find("gone") != std::string::npos);
  CHECK(tick == (10 - 2 + 1) * 6);
  const auto before = scene.tick(), after = scene.tick();
  CHECK_FALSE(scene.traffic.take_error().has_value());
  REQUIRE(before.size() == after.size());
  for (std::size_t i = 0; i < after.size(); ++i)
    CHECK(after[i].world_from_vehicle.position_m == before[i].world_from_vehicle.position_m);
}

TEST_CASE("a route leads as far as lanes do, and through sections of one road whose lanes the file does not link") {
  const auto road_of = [](const std::string& second) {
    return road::read_or_fail(
        road::SmallRoad{.length_m = 600.0,
                        .sections = road::lane_section("", road::lane(-1, 3.5)) + road::lane_section("", second, 300.0)}
            .xml());
  };
  const auto edges_of_route = [](const road::RoadNetwork& roads) {
    const auto corridor = traffic::build_corridor(roads, {0, -1, 1.0, 0.0});
    return place_in_sumo(make_sumo_network(roads), roads, corridor, 1, 100.0).route.size();
  };
  CHECK(edges_of_route(road_of(road::lane(-1, 3.5))) == 2);
  CHECK(edges_of_route(road_of(road::lane(-1, 3.5, "", "sidewalk") + road::lane(-2, 3.5))) == 1);
}

TEST_CASE("a road becomes one edge a direction whose lanes begin with the right-most") {
  const auto roads = traffic::ring_road(1000.0, 3);
  const SumoNetwork network = make_sumo_network(roads);
  REQUIRE(network.edges.size() == 1);
  CHECK(network.edges[0].lanes == std::vector<int>{-3, -2, -1});
  const auto corridor = traffic::build_corridor(roads, {0, -1, 1.0, 0.0});
  const SumoPlace place = place_in_sumo(network, roads, corridor, 1, 250.0);
  REQUIRE_FALSE(place.route.empty());
  CHECK(place.route.front() == network.edges[0].id);
  CHECK(place.lane_index == 2);
  CHECK(place.along_m == doctest::Approx(250.0));
  CHECK(network.connections_xml.find("fromLane=\"0\" toLane=\"0\"") != std::string::npos);
  CHECK(place_in_sumo(network, roads, corridor, 4, 250.0).route.empty());
}

TEST_CASE(
    "who stands behind one that does not move is held there with a small gap, presses to both sides in turn, and has "
    "his "
    "own gap again when he drives") {
  Scene scene;
  const VehicleModel car = scene.foreign[0].shape();
  const ParticipantId id = scene.sumo->vehicles.begin()->first;
  SumoVehicle& behind = scene.sumo->vehicles.at(id);
  const auto drive = [&](double time_s) {
    for (int tick = 0; tick < time_s * 120.0; ++tick) scene.tick();
  };
  behind.speed_mps = 0.0;
  behind.front_m.x = 2500.0 - car.rear_overhang_m - 1.5;
  drive(0.8);
  CHECK_FALSE(scene.sumo->held.contains(id));
  drive(0.8);
  CHECK(scene.sumo->held.contains(id));
  CHECK(scene.sumo->standstill_gap_m[id] == 0.1);
  CHECK_FALSE(scene.sumo->asked_aside_m.contains(id));
  drive(10.0);
  CHECK(scene.sumo->asked_aside_m[id] > 0.0);
  drive(10.0);
  CHECK(scene.sumo->asked_aside_m[id] < 0.0);

  scene.foreign[0].world_from_vehicle.position_m.x += 10.0;
  drive(0.2);
  CHECK_FALSE(scene.sumo->held.contains(id));
  CHECK(scene.sumo->standstill_gap_m[id] == 0.5);
  behind.speed_mps = 5.0;
  drive(0.2);
  CHECK(scene.sumo->standstill_gap_m[id] > 1.0);
}

}  // namespace septet::server
