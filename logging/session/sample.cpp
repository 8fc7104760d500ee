#include <cmath>

#include "logging/session/records.hpp"

namespace septet::logging {

Sample take_sample(const Snapshot& snapshot, const std::optional<Leader>& leader) {
  const DriverCar& car = snapshot.driver_car;
  Sample sample;
  sample.tick = snapshot.tick;
  sample.simulated_time_s = snapshot.simulated_time_s;
  if (const Participant* body = find_participant(snapshot, car.participant)) {
    const RigidTransform& pose = body->world_from_vehicle;
    const Vec3 acceleration = glm::conjugate(pose.orientation) * body->acceleration_mps2;
    sample.x_m = pose.position_m.x;
    sample.y_m = pose.position_m.y;
    sample.z_m = pose.position_m.z;
    sample.heading_rad = heading_rad(pose.orientation);
    sample.longitudinal_acceleration_mps2 = acceleration.x;
    sample.lateral_acceleration_mps2 = acceleration.y;
    sample.lamps = body->lamps;
  }
  sample.speed_mps = car.speed_mps;
  sample.yaw_rate_radps = car.yaw_rate_radps;
  sample.road = car.road;
  sample.lane = car.lane;
  sample.road_s_m = car.road_s_m;
  sample.lateral_position_m = car.lateral_position_m;
  sample.lane_width_m = car.lane_width_m;
  sample.leader = leader;
  sample.steering_wheel_rad = car.steering_wheel_rad;
  sample.accelerator = car.accelerator;
  sample.brake = car.brake;
  sample.clutch = car.clutch;
  sample.gear = car.gear;
  sample.gaze_heading_rad = car.gaze_heading_rad;
  return sample;
}

bool is_sample_due(Tick tick, double ticks_per_second) {
  // The k-th sample belongs to the first tick at or after k/10 s.
  const auto tenths_at = [&](double t) { return std::floor(t * 10.0 / ticks_per_second + 1e-9); };
  return tick == 0 || tenths_at(static_cast<double>(tick)) > tenths_at(static_cast<double>(tick) - 1.0);
}

}  // namespace septet::logging
