// A car that stands in a lane of a motorway, and is no wreck.

#include <array>
#include <cmath>

#include <doctest/doctest.h>

#include "tests/engine/traffic/bodies.hpp"
#include "tests/engine/traffic/dense_run.hpp"
#include "tests/engine/traffic/ring_road.hpp"

using namespace septet;
using namespace septet::traffic;

TEST_CASE("a car that stops in a lane, or across two, is gone round for as long as it stands, and touched by nobody") {
  struct Row {
    int lanes;
    double per_km_and_lane, t_m, turned_rad;
    int at_least;
  };
  for (const Row& row : {Row{3, 15.0, -5.625, 0.0, 150}, Row{5, 8.0, -1.875, 0.0, 150}, Row{5, 15.0, -7.5, 1.4, 150}}) {
    CAPTURE(row.t_m);
    const auto network = ring_road(5000.0, row.lanes);
    const TrafficParameters parameters = motorway_traffic(0, 1e6);
    TrafficState state =
        dense_ring(network, row.lanes, static_cast<std::uint32_t>(5.0 * row.lanes * row.per_km_and_lane), 4);
    CorridorTraffic& traffic = state.corridors[0];
    Random random(4);
    constexpr double step_s = 0.1;
    for (int step = 0; step < 600; ++step) advance(parameters, network, {}, step_s, random, state);
    double x_m = 1000.0, speed_mps = 20.0;
    int passed = 0, touches = 0;
    std::vector<double> before_m;
    std::vector<Participant> participants;
    for (int step = 0; step < 6000; ++step) {
      speed_mps = std::max(0.0, speed_mps - 2.0 * step_s);
      x_m += speed_mps * step_s;
      ForeignVehicle car;
      car.id = 1;
      car.model = model_named("volvo-s80");
      const double done = 1.0 - speed_mps / 20.0;
      const road::LanePosition lane{0, -1, x_m, 0.0};
      RigidTransform place = road::world_from_lane(road::evaluate_lane(network, lane));
      place.position_m += place.orientation * Vec3(0.0, row.t_m - road::evaluate_lane(network, lane).t_m, 0.0);
      car.velocity_mps = place.orientation * Vec3(speed_mps, 0.0, 0.0);
      place.orientation = place.orientation * orientation_from_angles(row.turned_rad * done, 0.0, 0.0);
      car.world_from_vehicle = place;
      const std::array foreign{car};
      before_m = traffic.x_m;
      advance(parameters, network, foreign, step_s, random, state);
      if (step < 3000) continue;
      for (std::size_t i = 0; i < traffic.size(); ++i) {
        const double left_m = distance_m(traffic.corridor, traffic.x_m[i], x_m);
        passed += left_m <= 0.0 && left_m > -100.0 && distance_m(traffic.corridor, before_m[i], x_m) > 0.0 ? 1 : 0;
      }
      if (step % 5 != 0) continue;
      participants.clear();
      append_participants(state, network, participants);
      for (const Participant& one : participants)
        touches += overlap(outline(one), outline(as_participant(car))) ? 1 : 0;
    }
    MESSAGE(passed << " come past in the second five minutes");
    CHECK(passed >= row.at_least);
    CHECK(touches == 0);
  }
}
