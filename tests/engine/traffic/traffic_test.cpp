#include "engine/traffic/traffic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <doctest/doctest.h>

#include "tests/engine/road/road_files.hpp"
#include "tests/relative.hpp"

namespace septet::traffic {
namespace {

/// A car that stays at x = 5 km in the middle lane at 30 m/s; the swarm's middle.
ForeignVehicle driver_at(const road::RoadNetwork& network, double s_m) {
  const auto point = road::evaluate_lane(network, {0, -3, s_m, 0.0});
  ForeignVehicle driver;
  driver.id = 1;
  driver.world_from_vehicle = road::world_from_lane(point);
  driver.velocity_mps = driver.world_from_vehicle.orientation * Vec3(30.0, 0.0, 0.0);
  return driver;
}

/// The smallest distance between bumpers in any lane.
double smallest_gap_m(const TrafficState& state) {
  double smallest = 1e9;
  for (const auto& traffic : state.corridors)
    for (std::size_t i = 0; i < traffic.size(); ++i)
      for (std::size_t j = 0; j < traffic.size(); ++j) {
        const bool same = traffic.lane[i] == traffic.lane[j] || traffic.from_lane[i] == traffic.lane[j];
        if (i == j || !same || traffic.x_m[j] < traffic.x_m[i]) continue;
        smallest = std::min(smallest, traffic.x_m[j] - traffic.length_m[j] - traffic.x_m[i]);
      }
  return smallest;
}

double distance(const Participant& a, const Participant& b) {
  return glm::distance(a.world_from_vehicle.position_m, b.world_from_vehicle.position_m);
}

}  // namespace

TEST_CASE("a vehicle whose acceleration is no number goes on at its speed and is counted") {
  const road::RoadNetwork& network = road::motorway();
  const ForeignVehicle driver = driver_at(network, 3000.0);
  Random random(1, 1);
  const TrafficParameters parameters = motorway_traffic(20, 300.0);
  TrafficState state = populate(parameters, network, std::span(&driver, 1), random);
  CorridorTraffic& traffic = state.corridors.front();
  std::size_t spoilt = 0;
  while (traffic.lane[spoilt] == 0) ++spoilt;
  FollowingParameters following = traffic.driver[spoilt].following;
  following.acceleration_mps2 = std::numeric_limits<double>::infinity();
  traffic.law[spoilt] = FollowingLaw(following);
  for (int tick = 0; tick < 60; ++tick) advance(parameters, network, std::span(&driver, 1), 1.0 / 120.0, random, state);
  CHECK(state.bad_numbers == 60);
  for (const CorridorTraffic& corridor : state.corridors)
    for (std::size_t i = 0; i < corridor.size(); ++i) CHECK(std::isfinite(corridor.x_m[i] + corridor.speed_mps[i]));
}

TEST_CASE("the equilibrium gap of the intelligent driver model gives no acceleration") {
  const FollowingParameters driver{33.33, 1.0, 2.6, 4.5, 2.5};
  for (const double speed : {5.0, 15.0, 28.0}) {
    const double gap = (driver.standstill_gap_m + speed * driver.time_gap_s) /
                       std::sqrt(1.0 - std::pow(speed / driver.desired_speed_mps, 4));
    CHECK(std::abs(FollowingLaw(driver).acceleration(speed, speed, gap)) < 1e-12);
  }
}

TEST_CASE("both directions of the motorway are one corridor each as long as the road") {
  const road::RoadNetwork& network = road::motorway();
  const Corridor along = build_corridor(network, {0, -3, 5000.0, 0.0});
  const auto opposite = opposite_lane(network, {0, -3, 5000.0, 0.0});
  REQUIRE(opposite);
  const Corridor against = build_corridor(network, *opposite);
  CHECK(along.length_m > 9000.0);
  CHECK(against.length_m == doctest::Approx(along.length_m));
  CHECK_FALSE(along.closed);
  // x is reversed on the other side.
  const auto x1 = x_of(network, along, {0, 1000.0, 0.0}, -2), x2 = x_of(network, against, {0, 1000.0, 0.0}, 2);
  REQUIRE(x1);
  REQUIRE(x2);
  CHECK(*x1 + *x2 == doctest::Approx(along.length_m));
}

TEST_CASE("two hundred vehicles on the motorway keep clear of each other for a minute") {
  const road::RoadNetwork& network = road::motorway();
  const TrafficParameters parameters = motorway_traffic(200, 1500.0);
  Random random(7, 1);
  double s_m = 2500.0;
  TrafficState state = populate(parameters, network, std::vector{driver_at(network, s_m)}, random);
  REQUIRE(state.corridors.size() == 2 + state.ramps.size());
  double smallest = smallest_gap_m(state);
  std::set<ParticipantId> changing;
  int changes = 0;
  for (int tick = 0; tick < 60 * 60; ++tick) {
    s_m += 30.0 / 60.0;
    advance(parameters, network, std::vector{driver_at(network, s_m)}, 1.0 / 60.0, random, state);
    if (tick % 20 == 0) smallest = std::min(smallest, smallest_gap_m(state));
    for (const auto& traffic : state.corridors)
      for (std::size_t i = 0; i < traffic.size(); ++i)
        changes += traffic.change_part[i] < 1.0 && changing.insert(traffic.id[i]).second;
  }
  MESSAGE("smallest gap " << smallest << " m; lane changes " << changes);
  CHECK(smallest > 0.3);
  CHECK(changes > 5);
  std::vector<Participant> participants;
  append_participants(state, network, participants);
  CHECK(participants.size() > 150);
}

TEST_CASE("vehicles leave by the exit and merge from the entry before its lane ends") {
  const road::RoadNetwork& network = road::motorway();
  TrafficParameters parameters = motorway_traffic(120, 1500.0);
  parameters.exit_share = 0.4;
  Random random(5, 1);
  const std::vector driver{driver_at(network, 6500.0)};
  TrafficState state = populate(parameters, network, driver, random);
  REQUIRE(state.ramps.size() == 1);
  const Ramp& ramp = state.ramps.front();
  CorridorTraffic &main = state.corridors[ramp.main], &way = state.corridors[ramp.way];
  CHECK(way.corridor.length_m == relative(800.7, 0.001));
  const std::size_t all = main.size();
  const double entry_ends_m = lane_end_m(main.table, ramp.entry.lane, ramp.entry.x_m + 1.0);
  REQUIRE(entry_ends_m < ramp.entry.x_m + 400.0);
  std::size_t left = 0, merged = 0, most_stopped = 0;
  double smallest = 1e9, longest_jump = 0.0, nearest = 1e9;
  std::vector<Participant> before, after;
  std::set<ParticipantId> on_way, in_entry;
  for (int tick = 0; tick < 300 * 60; ++tick) {
    advance(parameters, network, driver, 1.0 / 60.0, random, state);
    REQUIRE(main.size() + way.size() == all);
    std::set<ParticipantId> now_on_way(way.id.begin(), way.id.end()), now_in_entry;
    std::size_t stopped = 0;
    for (std::size_t i = 0; i < main.size(); ++i) {
      if (main.lane[i] != ramp.entry.lane || main.x_m[i] < ramp.entry.x_m) continue;
      now_in_entry.insert(main.id[i]);
      stopped += main.speed_mps[i] < 1.0;
      CHECK(main.x_m[i] < entry_ends_m);
    }
    most_stopped = std::max(most_stopped, stopped);
    for (const auto id : now_on_way) left += on_way.count(id) == 0;
    for (const auto id : in_entry) merged += now_in_entry.count(id) == 0;
    on_way = now_on_way;
    in_entry = now_in_entry;
    if (tick % 10 == 0) smallest = std::min(smallest, smallest_gap_m(state));
    before = std::exchange(after, {});
    append_participants(state, network, after);
    for (const Participant& a : after) {
      const auto b = std::ranges::find(before, a.id, &Participant::id);
      if (b == before.end()) continue;
      const double moved = glm::length(a.world_from_vehicle.position_m - b->world_from_vehicle.position_m);
      if (!on_way.contains(a.id) && !in_entry.contains(a.id)) continue;
      longest_jump = std::max(longest_jump, moved);
      for (const Participant& other : after)
        if (other.id != a.id) nearest = std::min(nearest, distance(a, other));
    }
  }
  MESSAGE(left << " left, " << merged << " merged, smallest gap " << smallest << " m, at most " << most_stopped
               << " standing in the entry, longest step " << longest_jump << " m");
  CHECK(left > 10);
  CHECK(merged > 5);
  CHECK(smallest > 0.3);
  CHECK(longest_jump < 0.8);
  // Beside each other in two lanes; behind each other they are farther apart.
  CHECK(nearest > 2.5);
}

TEST_CASE("a mix gives each kind its share and splits it among the classes as before") {
  TrafficParameters parameters = motorway_traffic(100, 1500.0);
  const TrafficParameters before = parameters;
  const auto share_of = [](const TrafficParameters& traffic, ParticipantKind kind) {
    double sum = 0.0;
    for (const VehicleClass& entry : traffic.classes)
      if (vehicle_models()[entry.model].kind == kind) sum += entry.share;
    return sum;
  };
  set_mix(parameters, {});
  CHECK(share_of(parameters, ParticipantKind::car) == share_of(before, ParticipantKind::car));
  const KindShare mix[] = {{ParticipantKind::car, 3.0}, {ParticipantKind::lorry, 1.0}, {ParticipantKind::bicycle, 5.0}};
  set_mix(parameters, mix);
  CHECK(share_of(parameters, ParticipantKind::car) == doctest::Approx(0.75));
  CHECK(share_of(parameters, ParticipantKind::lorry) == doctest::Approx(0.25));
  CHECK(share_of(parameters, ParticipantKind::van) == 0.0);
  CHECK(parameters.classes[0].share / parameters.classes[1].share ==
        doctest::Approx(before.classes[0].share / before.classes[1].share));
}

TEST_CASE("the same seed gives the same traffic") {
  const road::RoadNetwork& network = road::motorway();
  const TrafficParameters parameters = motorway_traffic(60, 1000.0);
  std::uint64_t hashes[2];
  for (auto& value : hashes) {
    Random random(9, 1);
    const std::vector driver{driver_at(network, 4000.0)};
    TrafficState state = populate(parameters, network, driver, random);
    for (int tick = 0; tick < 600; ++tick) advance(parameters, network, driver, 1.0 / 60.0, random, state);
    StateHash hash;
    hash_state(hash, state);
    value = hash.value();
  }
  CHECK(hashes[0] == hashes[1]);
}

TEST_CASE("shown motion agrees with shown velocity through lane changes") {
  const road::RoadNetwork& network = road::motorway();
  const TrafficParameters parameters = motorway_traffic(120, 1200.0);
  Random random(3, 1);
  const std::vector driver{driver_at(network, 3000.0)};
  TrafficState state = populate(parameters, network, driver, random);
  const double dt = 1.0 / 120.0;
  std::vector<Participant> before, after;
  int compared = 0, came_in_again = 0;
  for (int tick = 0; tick < 1200; ++tick) {
    before = std::exchange(after, {});
    advance(parameters, network, driver, dt, random, state);
    append_participants(state, network, after);
    if (before.size() != after.size()) continue;
    for (std::size_t i = 0; i < after.size(); ++i) {
      const Vec3 moved = after[i].world_from_vehicle.position_m - before[i].world_from_vehicle.position_m;
      if (after[i].id != before[i].id) continue;
      const auto from_driver_m = [&](const Participant& participant) {
        return glm::distance(participant.world_from_vehicle.position_m, driver.front().world_from_vehicle.position_m);
      };
      // A vehicle that leaves at one rim enters at the other, out of the driver's sight.
      if (glm::length(moved) > 2.0) {
        REQUIRE(from_driver_m(before[i]) > 0.9 * parameters.radius_m);
        REQUIRE(from_driver_m(after[i]) > 0.9 * parameters.radius_m);
        ++came_in_again;
        continue;
      }
      const Vec3 expected = 0.5 * dt * (after[i].velocity_mps + before[i].velocity_mps);
      REQUIRE(glm::length(moved - expected) < 0.01);
      ++compared;
    }
  }
  // No vehicle enters more than once in the ten seconds, and nearly all are compared.
  CHECK(came_in_again <= 120);
  CHECK(compared > 100 * 1100);
}

}  // namespace septet::traffic
