#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "tests/engine/traffic/emergency_run.hpp"
#include "tests/engine/traffic/ring_road.hpp"

namespace septet::traffic {
TEST_CASE("traffic hears the ambulance at 300 m and opens a lane right of the left-most") {
  const auto network = ring_road(5000.0, 5);
  const TrafficParameters parameters = motorway_traffic(0, 1e6);
  TrafficState state = dense_ring(network, 5, 700, 2);
  CorridorTraffic& traffic = state.corridors[0];
  Random random(2);
  for (int step = 0; step < 300; ++step) advance(parameters, network, {}, 0.1, random, state);
  ForeignVehicle ambulance;
  ambulance.id = 1;
  ambulance.model = model_named("ambulance");
  ambulance.lamps.set(Lamp::beacon, true);
  const auto point = road::evaluate_lane(network, {0, -2, 2000.0, 1.875});
  ambulance.world_from_vehicle = road::world_from_lane(point);
  const std::vector<ForeignVehicle> foreign{ambulance};
  for (int step = 0; step < 80; ++step) advance(parameters, network, foreign, 0.05, random, state);
  int near = 0, aside_left = 0, aside_right = 0, far_aside = 0;
  for (std::size_t i = 0; i < traffic.size(); ++i) {
    const double ahead = distance_m(traffic.corridor, 2000.0, traffic.x_m[i]);
    if (ahead > 60.0 && ahead < 250.0 && traffic.lane[i] <= 2 && traffic.from_lane[i] == traffic.lane[i]) {
      ++near;
      if (traffic.lane[i] == 1 && traffic.aside_m[i] > 0.5) ++aside_left;
      if (traffic.lane[i] == 2 && traffic.aside_m[i] < -0.5) ++aside_right;
    }
    if ((ahead > 450.0 || ahead < -300.0) && traffic.aside_m[i] != 0.0) ++far_aside;
  }
  CHECK(near > 3);
  CHECK(aside_left + aside_right == near);
  CHECK(far_aside == 0);
  // Gone: the lane closes.
  for (int step = 0; step < 600; ++step) advance(parameters, network, {}, 0.05, random, state);
  CHECK(std::ranges::all_of(traffic.aside_m, [](double aside) { return aside == 0.0; }));
}

TEST_CASE("an ambulance in dense traffic is half as fast again as the traffic without a collision") {
  const EmergencyRun run = drive_5_km(1);
  MESSAGE("ambulance " << run.ambulance_mps << " m/s, traffic " << run.traffic_mps << " m/s, overlaps "
                       << run.overlaps);
  CHECK(run.ambulance_mps >= 1.5 * run.traffic_mps);
  CHECK(run.overlaps == 0);
}

}  // namespace septet::traffic
