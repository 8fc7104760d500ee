// Crashes amid traffic: who drives on, and past what.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include <doctest/doctest.h>

#include "tests/engine/traffic/bodies.hpp"
#include "tests/engine/traffic/dense_run.hpp"
#include "tests/engine/traffic/ring_road.hpp"

using namespace septet;
using namespace septet::traffic;

namespace {

/// One of the traffic that slides to rest from its lane, turned against the road.
class Crashing {
 public:
  Crashing(TrafficState& state, const road::RoadNetwork& network, int lane, double rests_t_m)
      : network_(network), lane_(lane), rests_t_m_(rests_t_m) {
    const CorridorTraffic& traffic = state.corridors[0];
    std::size_t who = 0;
    while (traffic.lane[who] != lane || traffic.from_lane[who] != lane || std::abs(traffic.length_m[who] - 4.5) > 1.0)
      ++who;
    x_m_ = traffic.x_m[who];
    speed_mps_ = from_mps_ = traffic.speed_mps[who];
    vehicle_.id = traffic.id[who];
    vehicle_.model = traffic.model[who];
    vehicle_.adrift = true;
    remove_vehicle(vehicle_.id, state);
  }

  ForeignVehicle advance(double dt_s) {
    x_m_ += speed_mps_ * dt_s;
    speed_mps_ = std::max(0.0, speed_mps_ - 6.0 * dt_s);
    const double done = 1.0 - speed_mps_ / from_mps_;
    const double begins_t_m = -3.75 * (lane_ - 0.5);
    const auto frame = road::evaluate_lane(network_, {0, -1, x_m(), 0.0});
    RigidTransform place = road::world_from_lane(frame);
    place.position_m += place.orientation * Vec3(0.0, begins_t_m + (rests_t_m_ - begins_t_m) * done - frame.t_m, 0.0);
    vehicle_.velocity_mps = place.orientation * Vec3(speed_mps_, 0.0, 0.0);
    place.orientation = place.orientation * orientation_from_angles(1.4 * done, 0.0, 0.0);
    place.position_m -= place.orientation * Vec3(vehicle_models()[vehicle_.model].centre_x_m(), 0.0, 0.0);
    vehicle_.world_from_vehicle = place;
    return vehicle_;
  }

  double x_m() const { return std::fmod(x_m_, network_.roads[0].length_m); }
  bool rests() const { return speed_mps_ == 0.0; }

 private:
  const road::RoadNetwork& network_;
  int lane_;
  double rests_t_m_, x_m_ = 0.0, speed_mps_ = 0.0, from_mps_ = 1.0;
  ForeignVehicle vehicle_;
};

struct Jam {
  int passed = 0;    ///< Vehicles that come past in the last five minutes.
  int overlaps = 0;  ///< Pairs of the traffic, each half second.
  int touches = 0;   ///< Of the wreck, once it has been at rest for ten seconds.
  MotionCheck motion;
};

Jam crash(int lanes, double per_km_and_lane, int lane, double rests_t_m, std::uint64_t seed) {
  constexpr double step_s = 0.1, runs_s = 600.0, counts_from_s = 300.0;
  const auto network = ring_road(5000.0, lanes);
  const TrafficParameters parameters = motorway_traffic(0, 1e6);
  TrafficState state = dense_ring(network, lanes, static_cast<std::uint32_t>(5.0 * lanes * per_km_and_lane), seed);
  CorridorTraffic& traffic = state.corridors[0];
  Random random(seed);
  for (int step = 0; step < 600; ++step) advance(parameters, network, {}, step_s, random, state);
  Crashing crashing(state, network, lane, rests_t_m);
  Jam jam;
  std::vector<double> before_m;
  std::vector<Participant> participants;
  double rested_s = 0.0;
  for (int step = 0; step * step_s < runs_s; ++step) {
    const std::array foreign{crashing.advance(step_s)};
    before_m = traffic.x_m;
    advance(parameters, network, foreign, step_s, random, state);
    rested_s += crashing.rests() ? step_s : 0.0;
    for (std::size_t i = 0; i < traffic.size(); ++i) {
      const double left_m = distance_m(traffic.corridor, traffic.x_m[i], crashing.x_m());
      if (step * step_s > counts_from_s && left_m <= 0.0 && left_m > -100.0 &&
          distance_m(traffic.corridor, before_m[i], crashing.x_m()) > 0.0)
        ++jam.passed;
    }
    participants.clear();
    append_participants(state, network, participants);
    jam.motion.observe(participants);
    if (step % 5 != 0) continue;
    jam.overlaps += overlapping_pairs(participants);
    if (rested_s < 10.0) continue;
    for (const Participant& one : participants)
      if (glm::distance(one.world_from_vehicle.position_m, foreign[0].world_from_vehicle.position_m) < 30.0)
        jam.touches += overlap(outline(one), outline(as_participant(foreign[0]))) ? 1 : 0;
  }
  return jam;
}

}  // namespace

TEST_CASE("traffic goes on past a car that has crashed across two or three lanes and is let in lane by lane") {
  struct Row {
    int lanes;
    double per_km_and_lane;
    int lane;
    double rests_t_m;
    int at_least;  ///< Half of what comes past in five minutes with seeds 1 to 3.
  };
  for (const Row& row : {Row{2, 8.0, 1, -5.6, 30}, Row{3, 15.0, 1, -5.6, 80}, Row{5, 8.0, 2, -9.4, 150},
                         Row{5, 15.0, 1, -5.6, 170}, Row{5, 15.0, 4, -16.9, 190}})
    for (const std::uint64_t seed : {1, 2}) {
      const Jam jam = crash(row.lanes, row.per_km_and_lane, row.lane, row.rests_t_m, seed);
      CAPTURE(row.lanes);
      CAPTURE(row.rests_t_m);
      CAPTURE(seed);
      MESSAGE(row.lanes << " lanes, " << row.per_km_and_lane << " a km and lane: " << jam.passed << " in five minutes");
      CHECK(jam.passed >= row.at_least);
      CHECK(jam.overlaps == 0);
      CHECK(jam.touches == 0);
      CHECK(jam.motion.most_sideways_m < 0.02);
      CHECK(jam.motion.most_overturned_rad < 1e-3);
    }
}
