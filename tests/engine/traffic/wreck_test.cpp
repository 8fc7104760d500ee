// Wrecks: vehicles that lie across lanes or beside them, and the traffic that minds them.

#include <array>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "engine/traffic/traffic_engine.hpp"
#include "tests/engine/traffic/bodies.hpp"
#include "tests/engine/traffic/dense_run.hpp"
#include "tests/engine/traffic/ring_road.hpp"

using namespace septet;
using namespace septet::traffic;

namespace {

/// The middle of a saloon at x, `t_m` to the left of the reference line, turned against the road.
ForeignVehicle wreck_at(const road::RoadNetwork& network, double x_m, double t_m, double turned_rad,
                        std::string_view model = "saloon") {
  ForeignVehicle wreck;
  wreck.id = 2;
  wreck.model = model_named(model);
  wreck.adrift = true;
  const road::LanePosition lane{0, -1, x_m, 0.0};
  RigidTransform place = road::world_from_lane(road::evaluate_lane(network, lane));
  const double lane_t_m = road::evaluate_lane(network, lane).t_m;
  place.position_m += place.orientation * Vec3(0.0, t_m - lane_t_m, 0.0);
  place.orientation = place.orientation * orientation_from_angles(turned_rad, 0.0, 0.0);
  place.position_m -= place.orientation * Vec3(vehicle_models()[wreck.model].centre_x_m(), 0.0, 0.0);
  wreck.world_from_vehicle = place;
  return wreck;
}

/// Where the road is free of vehicles for the longest way behind.
double freest_x_m(const CorridorTraffic& traffic) {
  double best_m = 0.0, best_x_m = 0.0;
  for (double x = 0.0; x < traffic.corridor.length_m; x += 5.0) {
    double free_m = 1e9;
    for (std::size_t i = 0; i < traffic.size(); ++i) {
      const double behind_m = std::fmod(x - traffic.x_m[i] + traffic.corridor.length_m, traffic.corridor.length_m);
      const double ahead_m = traffic.corridor.length_m - behind_m;
      free_m = std::min(free_m, ahead_m < 15.0 ? 0.0 : behind_m);
    }
    if (free_m > best_m) best_m = free_m, best_x_m = x;
  }
  return best_x_m;
}

struct WreckRun {
  int touches = 0;         ///< Steps in which somebody overlaps it.
  double passed = 0.0;     ///< Vehicles that have come past.
  double least_mps = 1e9;  ///< Mean speed of all, at its least.
};

WreckRun meet(std::uint32_t vehicles, double seconds, double t_m, double turned_rad, std::string_view model) {
  const auto network = ring_road(5000.0, 3);
  const TrafficParameters parameters = motorway_traffic(0, 1e6);
  TrafficState state = dense_ring(network, 3, vehicles, 4);
  CorridorTraffic& traffic = state.corridors[0];
  Random random(4);
  constexpr double step_s = 0.1;
  for (int step = 0; step < 600; ++step) advance(parameters, network, {}, step_s, random, state);
  const double x_m = freest_x_m(traffic);
  const std::array foreign{wreck_at(network, x_m, t_m, turned_rad, model)};
  const Participant wreck = as_participant(foreign[0]);
  WreckRun run;
  std::vector<double> before;
  std::vector<Participant> participants;
  for (int step = 0; step * step_s < seconds; ++step) {
    before = traffic.x_m;
    advance(parameters, network, foreign, step_s, random, state);
    double sum_mps = 0.0;
    for (std::size_t i = 0; i < traffic.size(); ++i) {
      sum_mps += traffic.speed_mps[i];
      if (distance_m(traffic.corridor, before[i], x_m) > 0.0 &&
          distance_m(traffic.corridor, traffic.x_m[i], x_m) <= 0.0 &&
          std::abs(distance_m(traffic.corridor, traffic.x_m[i], x_m)) < 100.0)
        ++run.passed;
    }
    run.least_mps = std::min(run.least_mps, sum_mps / static_cast<double>(traffic.size()));
    participants.clear();
    append_participants(state, network, participants);
    for (const Participant& one : participants)
      if (glm::distance(one.world_from_vehicle.position_m, wreck.world_from_vehicle.position_m) < 30.0)
        run.touches += overlap(outline(one), outline(wreck)) ? 1 : 0;
  }
  return run;
}

}  // namespace

TEST_CASE("a wreck across two lanes of three is met by 200 vehicles for an hour and touched by nobody") {
  const WreckRun run = meet(200, 3600.0, -3.75, 1.4, "saloon");
  MESSAGE(run.passed << " passed, mean speed at its least " << run.least_mps << " m/s");
  CHECK(run.touches == 0);
  CHECK(run.passed > 600.0);
}

TEST_CASE("a wreck is touched by nobody wherever it lies, and passed where it leaves room") {
  struct Row {
    double t_m, turned_rad;
    const char* model;
    bool passable;
  };
  for (const Row& row : {Row{-1.9, 0.2, "saloon", true}, Row{-5.6, 2.6, "van", true}, Row{-11.9, 0.8, "saloon", true},
                         Row{-5.6, 1.5707963, "lorry", false}}) {
    CAPTURE(row.t_m);
    CAPTURE(row.turned_rad);
    const WreckRun run = meet(200, 300.0, row.t_m, row.turned_rad, row.model);
    CHECK(run.touches == 0);
    if (row.passable)
      CHECK(run.passed > 0.0);
    else
      CHECK(run.passed == 0.0);
  }
}

TEST_CASE("a vehicle that is released is nobody's any more, and its number is not given again") {
  const auto network = ring_road(5000.0, 3);
  const auto engine = own_traffic(network, 5);
  const std::array foreign{wreck_at(network, 100.0, -1.9, 0.0)};
  TrafficParameters parameters = motorway_traffic(60, 2000.0);
  parameters.opposite_share = 0.0;
  engine->start(parameters, foreign);
  std::vector<Participant> before, after;
  engine->append_participants(before);
  REQUIRE(before.size() == 60);
  const ParticipantId last = before.back().id;
  CHECK(engine->release(last));
  CHECK_FALSE(engine->release(last));
  CHECK_FALSE(engine->release(7));
  engine->worsen(3);
  for (int step = 0; step < 600; ++step) engine->advance(foreign, 0.1);
  engine->append_participants(after);
  CHECK(after.size() >= 59);
  for (const Participant& one : after) CHECK(one.id != last);
}
