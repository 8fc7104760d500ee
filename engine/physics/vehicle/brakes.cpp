#include <algorithm>
#include <cmath>

#include "engine/physics/vehicle/controls.hpp"
#include "engine/physics/vehicle/suspension.hpp"

// Anti-lock, traction and stability control after van Zanten 2000 ("Bosch ESP systems: 5 years of experience"), each
// reduced to its idea: hold a slip, hold the driven wheels' slip, hold the yaw rate of the driver's steering. On split
// friction the yaw moment of the brakes is built up with delay (Bosch Automotive Handbook, "Yaw-moment build-up
// delay").

namespace septet::vehicle {
namespace {

constexpr double control_from_mps = 1.5;

/// Slip of a braked wheel, a share of its forward speed: 1 is locked, negative is spinning.
double braking_slip(const VehicleParameters& parameters, const VehicleState& state, int wheel,
                    const Vec3& velocity_mps) {
  const double side_m = 0.5 * side_of(wheel) * parameters.suspension[axle_of(wheel)].track_m;
  const double forward_mps = velocity_mps.x - side_m * state.angular_velocity_radps.z;
  const double rolling_mps = state.wheels[wheel].spin_radps * parameters.tyre.radius_m * 0.98;
  const double size_mps = std::max(std::abs(forward_mps), 1.0);
  return (forward_mps - rolling_mps) * (forward_mps < 0.0 ? -1.0 : 1.0) / size_mps;
}

void advance_anti_lock(const VehicleParameters& parameters, const Vec3& velocity_mps, double dt_s,
                       VehicleState& state) {
  const bool fast = std::abs(velocity_mps.x) > control_from_mps;
  for (int i = 0; i < wheel_count; ++i) {
    const double over = braking_slip(parameters, state, i, velocity_mps) - parameters.brakes.anti_lock_slip;
    const double rate = fast ? std::clamp(60.0 * over, -4.0, 25.0) : -20.0;
    double& release = state.brakes.release[i];
    release = std::clamp(release + dt_s * rate, 0.0, 0.98);
  }
  // Select low: both rear wheels brake as the one with less grip, which keeps the rear axle's grip sideways where
  // friction is split.
  double& rear_left = state.brakes.release[2];
  double& rear_right = state.brakes.release[3];
  rear_left = rear_right = std::max(rear_left, rear_right);
}

/// Delays the yaw moment where one side has less grip and its front wheel is released: the other front wheel's pressure
/// follows it down and rises again only as fast as the car does not turn, so that the driver has the time to steer
/// against it.
void delay_yaw_moment(double yaw_rate_radps, double dt_s, BrakeState& brakes) {
  constexpr double bearable_radps = 0.01, rise_per_s = 0.8, fall_per_s = 6.0, gain_per_rad = 25.0;
  constexpr double least = 0.02;
  const int high = brakes.release[0] < brakes.release[1] ? 0 : 1;
  if (brakes.release[1 - high] - brakes.release[high] < least || brakes.pedal < 0.05) {
    brakes.front_difference = std::max(least, brakes.front_difference - dt_s * rise_per_s);
    return;
  }
  const double towards_high_radps = high == 0 ? yaw_rate_radps : -yaw_rate_radps;
  const double rate = gain_per_rad * (bearable_radps - towards_high_radps);
  brakes.front_difference =
      std::clamp(brakes.front_difference + dt_s * std::clamp(rate, -fall_per_s, rise_per_s), least, 1.0);
  brakes.release[high] = std::max(brakes.release[high], brakes.release[1 - high] - brakes.front_difference);
}

/// Share of the engine's torque to remove, by the excess speed of the fastest driven wheel.
double traction_cut(const VehicleParameters& parameters, const VehicleState& state, const Vec3& velocity_mps) {
  const double speed_mps = std::max(std::abs(velocity_mps.x), 1.0);
  double over_mps = 0.0;
  for (int i = 0; i < wheel_count; ++i)
    over_mps = std::max(over_mps, -braking_slip(parameters, state, i, velocity_mps) * speed_mps);
  return std::clamp(0.7 * (over_mps - std::max(0.08 * speed_mps, 0.5)), 0.0, 1.0);
}

/// Brakes one wheel when the car turns more (outer front) or less (inner rear) than the driver steers. Returns true
/// while it acts.
bool advance_stability_control(const VehicleParameters& parameters, const Vec3& velocity_mps, double dt_s,
                               VehicleState& state) {
  bool acts = false;
  const double speed = velocity_mps.x;
  const double yaw_rate = state.angular_velocity_radps.z;
  std::array<double, wheel_count> wanted{};
  if (speed > 5.0) {
    const double steer_rad = state.steering.column_rad / parameters.steering.ratio;
    const double lateral_mps2 = std::abs(yaw_rate * speed);
    const double most = (std::max(lateral_mps2, 2.0) + 1.5) / speed;
    const double asked = std::clamp(
        speed * steer_rad / (parameters.body.wheelbase_m + parameters.brakes.understeer_radps2pm * speed * speed),
        -most, most);
    const double error = yaw_rate - asked;
    const double direction = yaw_rate >= 0.0 ? 1.0 : -1.0;
    const double excess = std::abs(error) - 0.07;
    if (excess > 0.0) {
      const bool oversteer = error * direction > 0.0;
      const int outer = direction > 0.0 ? 1 : 0;
      wanted[oversteer ? outer : 2 + (1 - outer)] = std::min(0.6, (oversteer ? 4.0 : 1.5) * excess);
      acts = true;
    }
  }
  for (int i = 0; i < wheel_count; ++i)
    state.brakes.stabilising[i] += (wanted[i] - state.brakes.stabilising[i]) * dt_s / (0.03 + dt_s);
  return acts;
}

}  // namespace

std::array<double, wheel_count> advance_brakes(const VehicleParameters& parameters, const DriverInput& input,
                                               const Vec3& velocity_mps, double dt_s, VehicleState& state) {
  const BrakeParameters& brakes = parameters.brakes;
  BrakeState& controls = state.brakes;
  controls.pedal += (input.brake - controls.pedal) * dt_s / (brakes.lag_s + dt_s);
  if (brakes.anti_lock) advance_anti_lock(parameters, velocity_mps, dt_s, state);
  if (brakes.anti_lock && brakes.stability_control && velocity_mps.x > control_from_mps)
    delay_yaw_moment(state.angular_velocity_radps.z, dt_s, controls);
  double cut = brakes.traction_control ? traction_cut(parameters, state, velocity_mps) : 0.0;
  if (brakes.stability_control && advance_stability_control(parameters, velocity_mps, dt_s, state)) cut = 1.0;
  controls.torque_cut += (cut - controls.torque_cut) * dt_s / (0.06 + dt_s);

  const bool pawl = input.selector == GearSelector::park && std::abs(velocity_mps.x) < 1.0;
  std::array<double, wheel_count> torque_nm{};
  for (int i = 0; i < wheel_count; ++i) {
    const double pressure = std::clamp(controls.pedal + controls.stabilising[i], 0.0, 1.0);
    torque_nm[i] = brakes.full_torque_nm[axle_of(i)] * pressure * (1.0 - controls.release[i]);
    if (input.parking_brake && axle_of(i) == 1) torque_nm[i] += brakes.parking_torque_nm;
    const bool driven =
        axle_of(i) == 0 ? parameters.powertrain.front_share > 0.0 : parameters.powertrain.front_share < 1.0;
    if (pawl && driven) torque_nm[i] += brakes.full_torque_nm[0];
  }
  return torque_nm;
}

}  // namespace septet::vehicle
