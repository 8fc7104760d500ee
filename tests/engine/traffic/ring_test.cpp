#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "engine/traffic/fundamental_diagram.hpp"
#include "tests/engine/traffic/ring_road.hpp"
#include "tests/relative.hpp"

namespace septet::traffic {
namespace {

/// Equal cars on a ring of one lane, about 2 km round. Theory speaks of a straight road without an end: the ring's lane
/// is as long as its line here, and its bend bounds no speed.
TrafficState equal_cars(const road::RoadNetwork& network, int count, const Driver& driver, double uneven) {
  TrafficState state;
  state.corridors.push_back(empty_corridor(network, {0, -1, 1.0, 0.0}));
  CorridorTraffic& traffic = state.corridors[0];
  traffic.ways = {.straight = true, .lanes = std::vector<LaneWay>(traffic.ways.lanes.size())};
  for (int k = 0; k < count; ++k) {
    const double x = traffic.corridor.length_m / count * (k + uneven * std::sin(2.4 * k));
    add_vehicle(traffic, static_cast<ParticipantId>(k), model_named("saloon"), driver, 1, wrap_x(traffic.corridor, x),
                10.0);
    traffic.length_m.back() = 5.0;
  }
  for (LaneEntry& entry : traffic.order.lanes[1]) entry.length_m = 5.0;
  return state;
}

}  // namespace

TEST_CASE("a ring of equal cars settles at the equilibrium speeds of the intelligent driver model") {
  // The published ring is 2,011 m round, rounded: 2,011.3 m is the length that gives all three
  // speeds.
  const auto network = ring_road(2011.3, 1);
  const Driver driver{{33.33, 1.0, 2.6, 4.5, 2.5}, {}, 1.0};
  const struct {
    int count;
    double speed_mps;
  } expected[] = {{20, 32.174}, {40, 28.469}, {80, 16.955}};
  for (const auto& ring : expected) {
    CAPTURE(ring.count);
    const double speed = ring.speed_mps;
    TrafficState state = equal_cars(network, ring.count, driver, 0.0);
    TrafficParameters parameters;
    Random random(1);
    // At 80 cars the law itself is string-unstable (f_v²/2 + f_Δv f_v < f_s), so they start evenly.
    for (int step = 0; step < 12000; ++step) advance(parameters, network, {}, 0.1, random, state);
    const auto& speeds = state.corridors[0].speed_mps;
    CHECK(*std::ranges::min_element(speeds) == relative(speed, 0.001 / speed));
    CHECK(*std::ranges::max_element(speeds) == relative(speed, 0.001 / speed));
    CHECK(idm_equilibrium_speed(driver.following, 2011.3 / ring.count - 5.0) == relative(speed, 0.001 / speed));
  }
}

TEST_CASE("an unstable density grows stop-and-go waves out of a small disturbance") {
  const auto network = ring_road(2011.0, 1);
  // String-unstable: weak acceleration.
  const Driver driver{{33.33, 1.0, 0.5, 1.5, 2.0}, {}, 1.0};
  TrafficState state = equal_cars(network, 80, driver, 0.2);
  TrafficParameters parameters;
  Random random(1);
  for (int step = 0; step < 18000; ++step) advance(parameters, network, {}, 0.1, random, state);
  const auto& speeds = state.corridors[0].speed_mps;
  const double spread = *std::ranges::max_element(speeds) - *std::ranges::min_element(speeds);
  CHECK(spread > 5.0);
  CHECK(overlapping_bodies(state.corridors[0]) == 0);
}

TEST_CASE("a disturbance fades where theory calls equal drivers string-stable and grows where not") {
  const auto network = ring_road(2011.0, 1);
  constexpr int count = 80;
  const auto largest_difference = [&](double acceleration_mps2, double seconds) {
    const Driver driver{{33.33, 1.5, acceleration_mps2, 2.0, 2.0}, {}, 1.0};
    TrafficState state = equal_cars(network, count, driver, 0.0);
    CorridorTraffic& traffic = state.corridors[0];
    const double speed = idm_equilibrium_speed(driver.following, 2011.0 / count - 5.0);
    for (double& each : traffic.speed_mps) each = speed;
    traffic.speed_mps[0] -= 1.0;
    TrafficParameters parameters;
    Random random(1);
    for (double time = 0.0; time < seconds; time += 0.1) advance(parameters, network, {}, 0.1, random, state);
    const auto [least, most] = std::ranges::minmax_element(traffic.speed_mps);
    return *most - *least;
  };
  const auto margin = [&](double acceleration_mps2) {
    return idm_stability_margin({33.33, 1.5, acceleration_mps2, 2.0, 2.0}, 2011.0 / count - 5.0);
  };
  for (const double acceleration : {2.0, 2.6}) {
    CAPTURE(acceleration);
    CHECK(margin(acceleration) > 0.01);
    CHECK(largest_difference(acceleration, 600.0) < 0.01);
  }
  for (const double acceleration : {0.5, 1.0}) {
    CAPTURE(acceleration);
    CHECK(margin(acceleration) < -0.01);
    const double early = largest_difference(acceleration, 120.0);
    const double late = largest_difference(acceleration, 1800.0);
    MESSAGE("acceleration " << acceleration << ": " << early << " m/s, then " << late << " m/s");
    CHECK(late > 3.0 * early);
    CHECK(late > 3.0);
  }
}

TEST_CASE("flow rises with density until capacity and falls beyond") {
  double before = 0.0, most = 0.0;
  bool falls = false;
  const RingOptions ring{.settling_s = 300.0, .measuring_s = 30.0};
  for (const FlowPoint& point : fundamental_diagram(ring, std::vector{5.0, 15.0, 25.0, 45.0, 80.0})) {
    MESSAGE(point.density_per_km << " vehicles/km/lane: " << point.flow_per_h << " vehicles/h/lane");
    most = std::max(most, point.flow_per_h);
    falls = falls || point.flow_per_h < before;
    before = point.flow_per_h;
  }
  CHECK(falls);
  // Capacity of motorways: about 1,500 to 2,400 vehicles an hour and lane.
  CHECK(most > 1300.0);
  CHECK(most < 2600.0);
}

TEST_CASE("dense traffic changes lanes without touching") {
  const auto network = ring_road(3000.0, 3);
  const TrafficParameters parameters = motorway_traffic(0, 1e6);
  TrafficState state = dense_ring(network, 3, 225, 11);
  Random random(1);
  int overlaps = 0, changes = 0;
  for (int step = 0; step < 3000; ++step) {
    const auto lanes = state.corridors[0].lane;
    advance(parameters, network, {}, 0.1, random, state);
    for (std::size_t i = 0; i < lanes.size(); ++i) changes += lanes[i] != state.corridors[0].lane[i];
    overlaps += overlapping_bodies(state.corridors[0]);
  }
  MESSAGE(changes << " lane changes");
  CHECK(overlaps == 0);
  CHECK(changes > 50);
}

TEST_CASE("timid drivers keep longer gaps than aggressive ones") {
  const Driver middle;
  const auto gap_at_20 = [&](double temperament) {
    const FollowingParameters driver = with_temperament(middle, temperament).following;
    return (driver.standstill_gap_m + 20.0 * driver.time_gap_s) /
           std::sqrt(1.0 - std::pow(20.0 / driver.desired_speed_mps, 4));
  };
  CHECK(gap_at_20(0.0) > 1.2 * gap_at_20(0.5));
  CHECK(gap_at_20(0.5) > 1.2 * gap_at_20(1.0));
  CHECK(with_temperament(middle, 0.5).following.time_gap_s == middle.following.time_gap_s);
}

}  // namespace septet::traffic
