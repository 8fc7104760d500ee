#include "engine/physics/vehicle/manoeuvre_car.hpp"

#include <algorithm>
#include <cmath>

namespace septet::vehicle {

ManoeuvreCar::ManoeuvreCar(const VehicleParameters& parameters, const ManoeuvreOptions& options, double speed_mps)
    : parameters_(parameters), state_(standstill(parameters, {}, speed_mps)) {
  parameters_.brakes.stability_control &= options.stability_control.value_or(false);
  ground_ = level_ground(0.0, options.friction > 0.0 ? options.friction : parameters.tyre.reference_friction);
  if (speed_mps <= 0.0) return;
  const int settling = static_cast<int>(std::lround(options.settle_s / manoeuvre_step_s));
  for (int i = 0; i < settling; ++i) {
    hold_speed(speed_mps);
    advance(0.0);
  }
}

void ManoeuvreCar::advance(double steer_rad) {
  steer_rad_ = steer_rad;
  input_.steering_wheel_rad = steer_rad * parameters_.steering.ratio;
  advance_vehicle(parameters_, input_, ground_, manoeuvre_step_s, state_);
  ++steps_;
}

void ManoeuvreCar::advance_with_torques(const ChassisInput& chassis) {
  steer_rad_ = chassis.steer_rad;
  advance_chassis(parameters_, chassis, ground_, manoeuvre_step_s, state_);
  ++steps_;
}

void ManoeuvreCar::hold_speed(double speed_mps) {
  const double error_mps = speed_mps - outputs(parameters_, state_).speed_mps;
  // A pedal of 1 moves a light car without an engine ten times harder than the S80 in its highest gear.
  const double gain = parameters_.powertrain.transmission == Transmission::direct ? 0.3 : 1.0;
  integral_ = std::clamp(integral_ + 0.5 * gain * error_mps * manoeuvre_step_s, 0.0, 1.0);
  input_.accelerator = std::clamp(gain * error_mps + integral_, 0.0, 1.0);
}

void ManoeuvreCar::hold_gear() {
  input_.selector = GearSelector::manual;
  input_.gear = state_.powertrain.gear;
}

ManoeuvreSample ManoeuvreCar::sample() const {
  const VehicleOutputs now = outputs(parameters_, state_);
  ManoeuvreSample sample;
  sample.time_s = time_s();
  sample.x_m = state_.world_from_body.position_m.x;
  sample.y_m = state_.world_from_body.position_m.y;
  sample.heading_rad = heading_rad(state_.world_from_body.orientation);
  sample.steer_rad = steer_rad_;
  sample.speed_mps = now.speed_mps;
  sample.yaw_rate_radps = now.yaw_rate_radps;
  sample.lateral_acceleration_mps2 = now.lateral_acceleration_mps2;
  sample.longitudinal_acceleration_mps2 = now.longitudinal_acceleration_mps2;
  sample.sideslip_rad = now.sideslip_rad;
  sample.roll_rad = now.roll_rad;
  sample.steering_torque_nm = now.steering_torque_nm;
  sample.least_wheel_load_n = *std::min_element(now.wheel_load_n.begin(), now.wheel_load_n.end());
  return sample;
}

void ManoeuvreCar::begin() {
  steps_ = 0;
  state_.world_from_body.position_m.x = 0.0;
  state_.world_from_body.position_m.y = 0.0;
  series_.clear();
}

void ManoeuvreCar::record() {
  const long every = std::lround(sample_interval_s / manoeuvre_step_s);
  if (steps_ % every == 0) series_.push_back(sample());
}

double first_crossing(const std::vector<ManoeuvreSample>& series,
                      const std::function<double(const ManoeuvreSample&)>& key, double at,
                      const std::function<double(const ManoeuvreSample&)>& quantity) {
  for (std::size_t i = 1; i < series.size(); ++i) {
    const double before = key(series[i - 1]), after = key(series[i]);
    if (before < at && after >= at) {
      const double part = (at - before) / (after - before);
      return quantity(series[i - 1]) + part * (quantity(series[i]) - quantity(series[i - 1]));
    }
  }
  return series.empty() ? 0.0 : quantity(series.back());
}

}  // namespace septet::vehicle
