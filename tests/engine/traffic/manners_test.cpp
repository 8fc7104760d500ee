// A driver's behaviour towards others.

#include <doctest/doctest.h>

#include "tests/engine/traffic/ring_road.hpp"

namespace septet::traffic {
namespace {

/// A ring of five lanes with only those on it that a test puts there.
struct Ring {
  road::RoadNetwork network = ring_road(5000.0, 5);
  TrafficParameters parameters = motorway_traffic(0, 1e6);
  TrafficState state;
  Random random{1};

  Ring() { state.corridors.push_back(empty_corridor(network, road::LanePosition{0, -2, 1.0, 0.0})); }
  CorridorTraffic& traffic() { return state.corridors[0]; }
  void add(int lane, double x_m, double speed_mps, const Driver& driver) {
    add_vehicle(traffic(), 10 + static_cast<ParticipantId>(traffic().size()), model_named("saloon"), driver, lane, x_m,
                speed_mps);
    traffic().next_decision_s.back() = 1e9;  // Keeps its lane.
  }
  void advance_one(std::span<const ForeignVehicle> foreign, double dt_s) {
    advance(parameters, network, foreign, dt_s, random, state);
  }
};

/// True if a driver of this politeness changes to the left, where it gains 0.5 m/s² or more and costs another more than
/// that.
bool changes_left(double politeness) {
  Ring ring;
  Driver driver{{30.0, 1.3, 1.5, 2.5, 2.0}, {}, 1.0};
  driver.lane_change.politeness = politeness;
  constexpr double own_x = 500.0, own_mps = 20.0, behind_mps = 21.0, gap_ahead_m = 35.0, gap_behind_m = 26.0;
  const double length = vehicle_models()[model_named("saloon")].length_m;
  ring.add(2, own_x, own_mps, driver);
  ring.add(2, own_x + gap_ahead_m + length, own_mps, driver);
  ring.add(3, own_x, own_mps, driver);  // The path to the right is blocked.
  ring.add(1, own_x - length - gap_behind_m, behind_mps, driver);
  ring.traffic().next_decision_s[0] = 0.0;
  const FollowingLaw law(driver.following);
  const double gain = law.acceleration(own_mps, 0.0, no_leader) - law.acceleration(own_mps, own_mps, gap_ahead_m);
  const double loss =
      law.acceleration(behind_mps, 0.0, no_leader) - law.acceleration(behind_mps, own_mps, gap_behind_m);
  CHECK(gain > 0.5 + driver.lane_change.threshold_mps2 + driver.lane_change.keep_right_mps2);
  CHECK(loss > 1.2 * gain);
  CHECK(law.acceleration(behind_mps, own_mps, gap_behind_m) > -driver.lane_change.largest_braking_mps2);
  ring.advance_one({}, 0.1);
  return ring.traffic().lane[0] == 1;
}

/// True if a driver in lane 3 changes from behind a slow vehicle into the free lane 2, while a foreign car in lane 1
/// drives beside that place with these lamps on, last `lit_s` ago.
bool changes_beside(const Lamps& lamps, double lit_s) {
  Ring ring;
  Driver driver{{30.0, 1.3, 1.5, 2.5, 2.0}, {}, 1.0};
  constexpr double x_m = 500.0, mps = 20.0, dt_s = 0.05;
  const double length = vehicle_models()[model_named("saloon")].length_m;
  ring.add(3, x_m, mps, driver);
  ring.add(3, x_m + 25.0 + length, mps, driver);
  ring.add(4, x_m, mps, driver);
  ForeignVehicle car{.id = 1, .model = model_named("volvo-s80")};
  const auto advance_beside = [&](const Lamps& now) {
    car.lamps = now;
    car.world_from_vehicle =
        road::world_from_lane(road::evaluate_lane(ring.network, {0, -1, ring.traffic().x_m[0] - 3.0, 0.0}));
    car.velocity_mps = car.world_from_vehicle.orientation * Vec3(mps, 0.0, 0.0);
    ring.advance_one(std::span(&car, 1), dt_s);
  };
  advance_beside(lamps);
  for (double s = dt_s; s < lit_s; s += dt_s) advance_beside({});
  ring.traffic().next_decision_s[0] = 0.0;
  advance_beside(lit_s > 0.0 ? Lamps{} : lamps);
  return ring.traffic().lane[0] == 2;
}

}  // namespace

TEST_CASE("nobody changes into the place that somebody on its other side indicates to be going to") {
  Lamps none, left, right, hazard;
  left.set(Lamp::indicator_left, true);
  right.set(Lamp::indicator_right, true);
  hazard.set(Lamp::indicator_left, true);
  hazard.set(Lamp::indicator_right, true);
  CHECK(changes_beside(none, 0.0));
  CHECK(changes_beside(left, 0.0));
  CHECK(changes_beside(hazard, 0.0));
  CHECK_FALSE(changes_beside(right, 0.0));
  CHECK_FALSE(changes_beside(right, 0.3));  // Between two flashes.
  CHECK(changes_beside(none, 0.7));
  CHECK(changes_beside(right, 0.7));  // Switched off.
}

TEST_CASE("an egoist takes a gap that costs somebody else more than it gains, and a polite driver does not") {
  CHECK(changes_left(0.0));
  CHECK_FALSE(changes_left(0.9));
}

TEST_CASE("an ambulance is heard at 300 m and not before, and after the driver's reaction time") {
  Ring ring;
  constexpr double speed_mps = 20.0, dt_s = 0.05;
  const Driver driver{{speed_mps, 1.3, 1.5, 2.5, 2.0}, {}, 1.0};
  const double length = vehicle_models()[model_named("saloon")].length_m;
  ForeignVehicle ambulance{.id = 1, .model = model_named("ambulance")};
  ambulance.lamps.set(Lamp::siren, true);
  double x_m = 1000.0;
  const auto place = [&] {
    const auto point = road::evaluate_lane(ring.network, {0, -2, x_m, 1.875});
    ambulance.world_from_vehicle = road::world_from_lane(point);
    ambulance.velocity_mps = ambulance.world_from_vehicle.orientation * Vec3(speed_mps, 0.0, 0.0);
  };
  const double front_m = x_m + vehicle_models()[ambulance.model].front_m();
  ring.add(2, front_m + 290.0 + length, speed_mps, driver);
  ring.add(2, front_m + 310.0 + length, speed_mps, driver);
  for (double now_s = dt_s; now_s < 3.0; now_s += dt_s) {
    x_m += speed_mps * dt_s;
    place();
    ring.advance_one(std::span(&ambulance, 1), dt_s);
    CAPTURE(now_s);
    if (now_s < driver.reaction_s - 0.06) CHECK(ring.traffic().aside_target_m[0] == 0.0);
    if (now_s > driver.reaction_s + 0.06) CHECK(ring.traffic().aside_target_m[0] < -0.5);
    CHECK(ring.traffic().aside_target_m[1] == 0.0);
  }
}

TEST_CASE("who has let an ambulance by takes the time to react to the next one again") {
  Ring ring;
  constexpr double speed_mps = 20.0, dt_s = 0.05;
  const Driver driver{{speed_mps, 1.3, 1.5, 2.5, 2.0}, {}, 1.0};
  ring.add(2, 1200.0, speed_mps, driver);
  ForeignVehicle ambulance{.id = 1, .model = model_named("ambulance")};
  ambulance.lamps.set(Lamp::siren, true);
  const auto comes_up = [&](double time_s) {
    for (double now_s = 0.0; now_s < time_s; now_s += dt_s) {
      ambulance.world_from_vehicle =
          road::world_from_lane(road::evaluate_lane(ring.network, {0, -2, ring.traffic().x_m[0] - 100.0, 1.875}));
      ring.advance_one(std::span(&ambulance, 1), dt_s);
    }
  };
  comes_up(3.0);
  REQUIRE(ring.traffic().aside_target_m[0] != 0.0);
  for (int k = 0; k < 200; ++k) ring.advance_one({}, dt_s);
  REQUIRE(ring.traffic().aside_m[0] == 0.0);
  comes_up(0.8);
  CHECK(ring.traffic().aside_target_m[0] == 0.0);
  comes_up(0.4);
  CHECK(ring.traffic().aside_target_m[0] != 0.0);
}

TEST_CASE("who wants to keep right more than a change costs moves right where nobody is, and nobody moves left") {
  const auto lane_after = [](double keep_right_mps2) {
    Ring ring;
    Driver driver{{30.0, 1.3, 1.5, 2.5, 2.0}, {}, 1.0};
    driver.lane_change.threshold_mps2 = 0.2;
    driver.lane_change.keep_right_mps2 = keep_right_mps2;
    ring.add(3, 500.0, 30.0, driver);
    ring.traffic().next_decision_s[0] = 0.0;
    for (int k = 0; k < 20; ++k) ring.advance_one({}, 0.05);
    return ring.traffic().lane[0];
  };
  CHECK(lane_after(0.3) == 4);
  CHECK(lane_after(0.1) == 3);
  CHECK(lane_after(0.0) == 3);
}

TEST_CASE("after a change of lane two seconds pass before the next one is thought of") {
  Ring ring;
  Driver driver{{30.0, 1.3, 1.5, 2.5, 2.0}, {}, 1.0};
  driver.lane_change.keep_right_mps2 = 0.5;
  ring.add(2, 500.0, 30.0, driver);
  ring.traffic().next_decision_s[0] = 0.0;
  double arrived_s = -1.0, left_again_s = -1.0;
  for (double now_s = 0.05; now_s < 20.0 && left_again_s < 0.0; now_s += 0.05) {
    ring.advance_one({}, 0.05);
    const bool changes = ring.traffic().from_lane[0] != ring.traffic().lane[0];
    if (arrived_s < 0.0 && ring.traffic().lane[0] == 3 && !changes) arrived_s = now_s;
    if (arrived_s >= 0.0 && ring.traffic().lane[0] == 4) left_again_s = now_s;
  }
  REQUIRE(left_again_s > 0.0);
  CHECK(left_again_s - arrived_s > 1.9);
  CHECK(left_again_s - arrived_s < 2.6);
}

}  // namespace septet::traffic
