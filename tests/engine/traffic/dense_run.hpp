#pragma once
/// Hours of dense traffic on a ring of five lanes, observed from outside.

#include "tests/engine/traffic/bodies.hpp"
#include "tests/engine/traffic/ring_road.hpp"

namespace septet::traffic {

struct DenseRun {
  double vehicle_hours = 0.0;
  int overlaps = 0;
  MotionCheck motion;
  double hard_braking_s = 0.0;  ///< Time of all vehicles below −6 m/s².
  double least_mps2 = 0.0;
};

/// A car on the line between lanes 2 and 3 that comes to rest there, starting at the largest gap.
class Obstacle {
 public:
  explicit Obstacle(const CorridorTraffic& traffic) {
    double most = -1e9;
    for (double at = 0.0; at < traffic.corridor.length_m; at += 5.0) {
      double least = 1e9;
      for (std::size_t i = 0; i < traffic.size(); ++i) {
        if (std::max(traffic.lane[i], traffic.from_lane[i]) < 2) continue;
        if (std::min(traffic.lane[i], traffic.from_lane[i]) > 3) continue;
        const double ahead = distance_m(traffic.corridor, at, traffic.x_m[i]);
        least = std::min(least, ahead > 0.0 ? ahead - traffic.length_m[i] : -ahead - 5.0);
      }
      if (least > most) most = least, x_m_ = at;
    }
    double sum = 0.0;
    for (const double speed : traffic.speed_mps) sum += speed;
    speed_mps_ = sum / static_cast<double>(traffic.size());
  }

  void advance(double dt_s) {
    x_m_ += speed_mps_ * dt_s;
    speed_mps_ = std::max(0.0, speed_mps_ - 2.0 * dt_s);
  }

  ForeignVehicle vehicle(const road::RoadNetwork& network, const Corridor& corridor) const {
    ForeignVehicle car;
    car.id = 1;
    car.model = model_named("volvo-s80");
    const VehicleModel& model = vehicle_models()[car.model];
    const double origin_m = wrap_x(corridor, x_m_ - model.front_m());
    car.world_from_vehicle = road::world_from_lane(road::evaluate_lane(network, {0, -2, origin_m, -1.875}));
    car.velocity_mps = car.world_from_vehicle.orientation * Vec3(speed_mps_, 0.0, 0.0);
    return car;
  }

 private:
  double x_m_ = 0.0, speed_mps_ = 0.0;
};

inline Participant as_participant(const ForeignVehicle& vehicle) {
  Participant participant;
  participant.id = vehicle.id;
  participant.model = vehicle.model;
  participant.world_from_vehicle = vehicle.world_from_vehicle;
  return participant;
}

/// A ring of 5 km × 5 lanes at this density, from a minute's settling on.
inline DenseRun drive_dense(double per_km_and_lane, double seconds, std::uint64_t seed, bool obstacle) {
  const auto network = ring_road(5000.0, 5);
  const TrafficParameters parameters = motorway_traffic(0, 1e6);
  TrafficState state = dense_ring(network, 5, static_cast<std::uint32_t>(25.0 * per_km_and_lane), seed);
  CorridorTraffic& traffic = state.corridors[0];
  Random random(seed);
  DenseRun run;
  std::vector<Participant> participants;
  constexpr double step_s = 0.1;
  for (int step = 0; step < 600; ++step) advance(parameters, network, {}, step_s, random, state);
  Obstacle car(traffic);
  std::vector<ForeignVehicle> foreign;
  const int steps = static_cast<int>(seconds / step_s);
  for (int step = 0; step < steps; ++step) {
    if (obstacle) {
      car.advance(step_s);
      foreign.assign(1, car.vehicle(network, traffic.corridor));
    }
    advance(parameters, network, foreign, step_s, random, state);
    for (const double a : traffic.acceleration_mps2) {
      run.least_mps2 = std::min(run.least_mps2, a);
      if (a < -6.0) run.hard_braking_s += step_s;
    }
    participants.clear();
    append_participants(state, network, participants);
    run.motion.observe(participants);
    if (step % 5 != 0) continue;
    for (const ForeignVehicle& vehicle : foreign) participants.push_back(as_participant(vehicle));
    run.overlaps += overlapping_pairs(participants);
  }
  run.vehicle_hours = seconds / 3600.0 * static_cast<double>(traffic.size());
  return run;
}

}  // namespace septet::traffic
