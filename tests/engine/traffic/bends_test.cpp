// Published motion of traffic in bends and on hills, its gaps there, and its speed.

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/road/lane_geometry.hpp"
#include "engine/traffic/traffic_engine.hpp"
#include "engine/traffic/traffic_stages.hpp"
#include "tests/engine/traffic/bend_road.hpp"
#include "tests/engine/traffic/ring_road.hpp"
#include "tests/relative.hpp"

namespace septet::traffic {
namespace {

constexpr double tick_s = 1.0 / 120.0;

ForeignVehicle somebody_at(const road::RoadNetwork& network, double s_m, bool with_beacon = false) {
  ForeignVehicle vehicle;
  vehicle.id = 1;
  vehicle.world_from_vehicle = road::world_from_lane(road::evaluate_lane(network, {0, -1, s_m, 0.0}));
  vehicle.velocity_mps = vehicle.world_from_vehicle.orientation * Vec3(8.0, 0.0, 0.0);
  vehicle.lamps.set(Lamp::beacon, with_beacon);
  return vehicle;
}

using Told = std::map<ParticipantId, Participant>;

/// Share of ticks at which a published quantity differed from the derivative of its neighbours.
struct Derivatives {
  std::size_t seen = 0, velocity_off = 0, yaw_off = 0, acceleration_off = 0;
  double most_yaw_radps = 0.0;

  void observe(const Told& before, const Told& now, const Told& after) {
    for (const auto& [id, p] : now) {
      const auto b = before.find(id), a = after.find(id);
      if (b == before.end() || a == after.end()) continue;
      const Vec3 moved =
          (a->second.world_from_vehicle.position_m - b->second.world_from_vehicle.position_m) / (2.0 * tick_s);
      const double speed = glm::length(p.velocity_mps);
      if (speed < 3.0 || glm::length(moved) > 100.0) continue;  // Slow, or set somewhere else.
      ++seen;
      velocity_off += glm::length(moved - p.velocity_mps) > 1e-3 * speed;
      const double turned = std::remainder(heading_rad(a->second.world_from_vehicle.orientation) -
                                               heading_rad(b->second.world_from_vehicle.orientation),
                                           2.0 * std::numbers::pi) /
                            (2.0 * tick_s);
      most_yaw_radps = std::max(most_yaw_radps, std::abs(turned));
      yaw_off += std::abs(turned - p.angular_velocity_radps.z) > 1e-3 + 0.01 * std::abs(turned);
      const Vec3 gained = (a->second.velocity_mps - b->second.velocity_mps) / (2.0 * tick_s);
      acceleration_off += glm::length(gained - p.acceleration_mps2) > 0.05 + 0.02 * glm::length(gained);
    }
  }
};

Derivatives drive(const road::RoadNetwork& network, double seconds, bool with_beacon = false) {
  TrafficParameters parameters = motorway_traffic(24, 400.0);
  parameters.decision_interval_s = 0.2;
  const std::vector somebody{somebody_at(network, 0.5 * network.roads[0].length_m, with_beacon)};
  Random random(3, 1);
  TrafficState state = populate(parameters, network, somebody, random);
  Told before, now;
  Derivatives found;
  for (int tick = 0; tick * tick_s < seconds; ++tick) {
    advance(parameters, network, somebody, tick_s, random, state);
    std::vector<Participant> all;
    append_participants(state, network, all);
    Told after;
    for (const Participant& p : all) after[p.id] = p;
    found.observe(before, now, after);
    before = std::move(now);
    now = std::move(after);
  }
  return found;
}

/// Two cars in one lane, the one behind as it follows in equilibrium.
struct Pair {
  TrafficState state;
  CorridorTraffic& traffic;
  Pair(const road::RoadNetwork& network, int lane, double speed_mps)
      : state(make(network)), traffic(state.corridors.front()) {
    const Driver calm{{16.0, 1.4, 1.5, 2.5, 2.0}, {}, 1.0};
    Driver slow = calm;
    slow.following.desired_speed_mps = speed_mps;
    add_vehicle(traffic, 10, model_named("saloon"), calm, lane, 20.0, speed_mps);
    add_vehicle(traffic, 11, model_named("saloon"), slow, lane, 50.0, speed_mps);
  }
  static TrafficState make(const road::RoadNetwork& network) {
    TrafficState made;
    made.corridors.push_back(empty_corridor(network, {0, -1, 1.0, 0.0}));
    return made;
  }
};

/// Fastest in the lane over the last part of the road, by published speed; and the hardest braking on the path.
struct Fastest {
  double mps = 0.0, braking_mps2 = 0.0, sideways_mps2 = 0.0;
};

/// One car after another along the road, from 27 m/s on; `from_s` and `to_s` bound where they are looked at.
Fastest fastest_between(const road::RoadNetwork& network, int lane, double from_s, double to_s,
                        double set_out_mps = 27.0) {
  Fastest fastest;
  const TrafficParameters parameters = motorway_traffic(0, 1e6);
  Random random(1);
  TrafficState state;
  state.corridors.push_back(empty_corridor(network, {0, lane < 0 ? -1 : 1, 1.0, 0.0}));
  CorridorTraffic& traffic = state.corridors.front();
  add_vehicle(traffic, 10, model_named("saloon"), Driver{{36.0, 1.2, 1.5, 2.5, 2.0}, {}, 1.0}, std::abs(lane), 10.0,
              set_out_mps);
  while (traffic.x_m[0] < std::min(to_s, traffic.corridor.length_m - 20.0)) {
    follow(traffic);
    move(network, traffic, tick_s);
    fastest.braking_mps2 = std::max(fastest.braking_mps2, -traffic.acceleration_mps2[0]);
    if (traffic.x_m[0] < from_s) continue;
    std::vector<Participant> told;
    append_participants(state, network, told);
    if (told.empty()) continue;
    fastest.mps = std::max(fastest.mps, glm::length(told[0].velocity_mps));
    fastest.sideways_mps2 =
        std::max(fastest.sideways_mps2, std::abs(glm::length(told[0].velocity_mps) * told[0].angular_velocity_radps.z));
  }
  return fastest;
}

std::string limit_from(double s_m, int kmh) {
  return fmt::format(R"(<type s="{}" type="town"><speed max="{}" unit="km/h"/></type>)", s_m, kmh);
}

}  // namespace

TEST_CASE(
    "what is told of traffic is the derivative of where it is told to be, in bends, on hills and where lanes widen") {
  const RoadText roads[] = {
      {.geometry = arc(800.0, 0.02), .length_m = 800.0},
      {.geometry = arc(800.0, -0.00667), .length_m = 800.0},
      {.geometry = spiral(900.0, -0.012, 0.015), .length_m = 900.0},
      {.geometry = arc(900.0, 0.004),
       .length_m = 900.0,
       .elevation = R"(<elevation s="0" a="0" b="0.02" c="0.00008" d="0"/>)",
       .superelevation = R"(<superelevation s="0" a="0.01" b="0.00005" c="0" d="0"/>)"},
      {.geometry = arc(900.0, -0.008), .length_m = 900.0, .widening = R"(b="0.002" c="0.000001")"},
  };
  for (const RoadText& text : roads) {
    CAPTURE(text.geometry);
    const auto network = read_road(text);
    const Derivatives found = drive(network, 30.0);
    MESSAGE(found.seen << " seen; off: velocity " << found.velocity_off << ", yaw rate " << found.yaw_off
                       << ", acceleration " << found.acceleration_off);
    CHECK(found.seen > 20000);
    CHECK(found.most_yaw_radps > 0.03);
    // Where a bend begins at once, or a driver begins to steer, there is no derivative.
    CHECK(found.velocity_off < found.seen / 1000);
    CHECK(found.yaw_off < found.seen / 100);
    CHECK(found.acceleration_off < found.seen / 50);
  }
}

TEST_CASE("who makes way for a beacon in a bend moves sideways as it is told") {
  const auto network = read_road({.geometry = arc(800.0, 0.01), .length_m = 800.0});
  const Derivatives found = drive(network, 20.0, true);
  MESSAGE(found.seen << " seen; off: velocity " << found.velocity_off << ", yaw rate " << found.yaw_off);
  CHECK(found.seen > 5000);
  CHECK(found.velocity_off < found.seen / 1000);
  CHECK(found.yaw_off < found.seen / 50);
}

TEST_CASE("in a bend a follower keeps its gap along the lane and not along the reference line") {
  const double curvature = 0.02;
  const auto network = read_road({.geometry = arc(1500.0, curvature), .length_m = 1500.0});
  for (const int lane : {1, 2}) {
    Pair pair(network, lane, 8.0);
    const TrafficParameters parameters = motorway_traffic(0, 1e6);
    Random random(1);
    for (int tick = 0; tick < 60 * 60; ++tick) {
      refresh_order(pair.traffic, {});
      follow(pair.traffic);
      move(network, pair.traffic, 1.0 / 60.0);
    }
    CHECK(pair.traffic.speed_mps[0] == relative(pair.traffic.speed_mps[1], 1e-3));
    const double stretch = 1.0 + curvature * (lane - 0.5) * 3.5;
    const double gap_m = (pair.traffic.x_m[1] - pair.traffic.x_m[0]) * stretch - pair.traffic.length_m[1];
    const FollowingParameters& following = pair.traffic.driver[0].following;
    const double v = pair.traffic.speed_mps[0];
    const double wanted_m = (following.standstill_gap_m + v * following.time_gap_s) /
                            std::sqrt(1.0 - std::pow(v / following.desired_speed_mps, 4));
    CHECK(gap_m == relative(wanted_m, 0.01));
  }
}

TEST_CASE("the way along a lane is its length: 1 - t/R, on a ring round and round, and of a road that climbs") {
  const auto network = read_road({.geometry = arc(300.0, 0.02), .length_m = 300.0});
  const auto traffic = empty_corridor(network, road::LanePosition{0, -1, 1.0, 0.0});
  CHECK(way_between_m(traffic.corridor, traffic.ways.lanes[1], 50.0, 150.0) == relative(100.0 * 1.035, 1e-9));
  CHECK(way_between_m(traffic.corridor, traffic.ways.lanes[2], 150.0, 50.0) == relative(-100.0 * 1.105, 1e-9));
  const auto against = empty_corridor(network, road::LanePosition{0, 1, 1.0, 0.0});
  CHECK(way_between_m(against.corridor, against.ways.lanes[1], 50.0, 150.0) == relative(100.0 * 0.965, 1e-9));

  const auto bent = read_road({.geometry = spiral(303.0, 0.0, 0.02), .length_m = 303.0});
  const auto beside = empty_corridor(bent, road::LanePosition{0, -1, 1.0, 0.0});
  CHECK(way_between_m(beside.corridor, beside.ways.lanes[1], 0.0, 303.0) ==
        relative(303.0 + 1.75 * 0.5 * 0.02 * 303.0, 1e-6));
  CHECK(way_between_m(beside.corridor, beside.ways.lanes[1], -10.0, 0.0) == doctest::Approx(10.0));

  const auto hill = read_road(
      {.geometry = straight(400.0), .length_m = 400.0, .elevation = R"(<elevation s="0" a="0" b="0.1" c="0" d="0"/>)"});
  const auto up = empty_corridor(hill, road::LanePosition{0, -1, 1.0, 0.0});
  CHECK(way_between_m(up.corridor, up.ways.lanes[1], 0.0, 400.0) == relative(400.0 * std::sqrt(1.01), 1e-9));

  const auto ring = ring_road(1000.0, 2);
  const auto round = empty_corridor(ring, road::LanePosition{0, -2, 1.0, 0.0});
  const double stretch = 1.0 + 1.5 * 3.75 * 2.0 * std::numbers::pi / 1000.0;
  CHECK(way_between_m(round.corridor, round.ways.lanes[2], 950.0, 50.0) == relative(100.0 * stretch, 1e-6));
}

TEST_CASE("nobody drives faster than is posted, and is down to it where it is") {
  // Posted from the begin; posted lower from the middle on; of one lane alone; up a hill; on the other side of the
  // road.
  const auto town = read_road({.geometry = straight(900.0), .length_m = 900.0, .type = limit_from(0.0, 50)});
  CHECK(fastest_between(town, -1, 300.0, 900.0).mps < 1.01 * 50.0 / 3.6);
  CHECK(fastest_between(town, -1, 300.0, 900.0).mps > 0.95 * 50.0 / 3.6);

  const auto lower = read_road(
      {.geometry = straight(1200.0), .length_m = 1200.0, .type = limit_from(0.0, 100) + limit_from(600.0, 30)});
  const Fastest slowed = fastest_between(lower, -2, 601.0, 1200.0);
  CHECK(slowed.mps < 1.02 * 30.0 / 3.6);
  CHECK(slowed.braking_mps2 < 2.0);
  CHECK(fastest_between(lower, -2, 200.0, 350.0).mps > 25.0);
  CHECK(fastest_between(lower, 1, 700.0, 1200.0).mps > 25.0);  // The other way: x begins at the road's end.
  CHECK(fastest_between(lower, 1, 300.0, 590.0, 8.0).mps < 1.02 * 30.0 / 3.6);

  const auto lane = read_road({.geometry = straight(900.0),
                               .length_m = 900.0,
                               .type = limit_from(0.0, 80),
                               .lane_speed = R"(<speed sOffset="0" max="36" unit="km/h"/>)"});
  CHECK(fastest_between(lane, -1, 300.0, 900.0).mps < 1.01 * 10.0);
  CHECK(fastest_between(lane, -2, 300.0, 900.0).mps > 0.95 * 80.0 / 3.6);
}

TEST_CASE("in a bend nobody is pulled sideways more than is comfortable, and brakes for it before") {
  const std::string into = R"(<geometry s="0" x="0" y="0" hdg="0" length="400"><line/></geometry>)"
                           R"(<geometry s="400" x="400" y="0" hdg="0" length="200"><arc curvature="0.02"/></geometry>)";
  const auto network = read_road({.geometry = into, .length_m = 600.0});
  for (const int lane : {-1, -2}) {
    const Fastest fastest = fastest_between(network, lane, 150.0, 600.0);
    CHECK(fastest.sideways_mps2 < 1.05 * bend_mps2);
    CHECK(fastest.sideways_mps2 > 0.8 * bend_mps2);
    CHECK(fastest.braking_mps2 < 2.0);
  }
  // A gentle bend, and one to the right whose inner lane is tighter.
  const auto gentle = read_road({.geometry = arc(900.0, 0.001), .length_m = 900.0});
  CHECK(fastest_between(gentle, -1, 600.0, 900.0).mps > 30.0);
  const auto right = read_road({.geometry = arc(600.0, -0.01), .length_m = 600.0});
  CHECK(fastest_between(right, -2, 200.0, 600.0).sideways_mps2 < 1.05 * bend_mps2);
  CHECK(fastest_between(right, -2, 200.0, 600.0).mps < fastest_between(right, 1, 200.0, 560.0).mps);
}

TEST_CASE("a swarm that thins out on a road shorter than its radius says so, each time that a further tenth has gone") {
  const auto network = read_road(
      {.geometry = R"(<geometry s="0" x="0" y="0" hdg="0" length="500"><line/></geometry>)", .length_m = 500.0});
  const std::vector somebody{somebody_at(network, 60.0)};
  const TrafficParameters parameters = motorway_traffic(20, 280.0);
  const auto traffic = own_traffic(network, 1);
  traffic->start(parameters, somebody);
  std::vector<std::size_t> on_road;
  for (int tick = 0; tick < 60 * 120; ++tick) {
    traffic->advance(somebody, tick_s);
    if (const auto remark = traffic->take_remark()) {
      CHECK(remark->starts_with("asked=20 on_road="));
      on_road.push_back(std::stoul(remark->substr(remark->rfind('=') + 1)));
    }
  }
  REQUIRE(!on_road.empty());
  CHECK(on_road.size() <= 10);
  for (std::size_t i = 1; i < on_road.size(); ++i) CHECK(on_road[i] + 2 < on_road[i - 1]);
  std::vector<Participant> left;
  traffic->append_participants(left);
  CHECK(left.size() < on_road.back() + 3);  // Somebody may come in again at the other rim.
  CHECK(on_road.back() < left.size() + 5);
}

TEST_CASE("a swarm is set out no faster than bends and limits allow") {
  const auto network = read_road({.geometry = arc(280.0, 0.02), .length_m = 280.0, .type = limit_from(0.0, 50)});
  const std::vector somebody{somebody_at(network, 60.0)};
  const TrafficParameters parameters = motorway_traffic(12, 280.0);
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u}) {
    Random random(seed, 1);
    TrafficState state = populate(parameters, network, somebody, random);
    std::vector<Participant> told;
    for (int tick = 0; tick < 1200; ++tick) {
      if (tick % 12 == 0) {
        told.clear();
        append_participants(state, network, told);
        for (const Participant& p : told) {
          const double speed = glm::length(p.velocity_mps);
          REQUIRE(speed < 1.02 * 50.0 / 3.6);
          // A change of lane adds as much as 1 m/s².
          REQUIRE(std::abs(speed * p.angular_velocity_radps.z) < bend_mps2 + 1.1);
        }
      }
      advance(parameters, network, somebody, tick_s, random, state);
    }
    CHECK(told.size() >= 3);
  }
}

}  // namespace septet::traffic
