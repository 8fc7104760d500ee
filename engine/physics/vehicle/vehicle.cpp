#include "engine/physics/vehicle/vehicle.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/check.hpp"
#include "engine/physics/vehicle/controls.hpp"
#include "engine/physics/vehicle/equations_of_motion.hpp"
#include "engine/physics/vehicle/suspension.hpp"

namespace septet::vehicle {
namespace {

double bounded(double value, double low, double high) {
  return std::isfinite(value) ? std::clamp(value, low, high) : std::clamp(0.0, low, high);
}

/// Clamps controls to their bounds.
DriverInput bounded(DriverInput input) {
  input.steering_wheel_rad = bounded(input.steering_wheel_rad, -50.0, 50.0);
  for (double* pedal : {&input.accelerator, &input.brake, &input.clutch}) *pedal = bounded(*pedal, 0.0, 1.0);
  return input;
}

bool finite(const Vec3& v) { return std::isfinite(v.x + v.y + v.z); }

bool finite(const VehicleState& state) {
  const Quat& q = state.world_from_body.orientation;
  double sum = q.w + q.x + q.y + q.z + state.steering.column_rad + state.powertrain.engine_radps +
               state.powertrain.engine_torque_nm + state.brakes.pedal + state.brakes.torque_cut;
  for (const WheelState& wheel : state.wheels)
    sum += wheel.travel_m + wheel.travel_rate_mps + wheel.spin_rad + wheel.spin_radps + wheel.deflection_m.x +
           wheel.deflection_m.y + wheel.damage.rim_bend_m + wheel.damage.lost_air;
  return std::isfinite(sum) && finite(state.world_from_body.position_m) && finite(state.velocity_mps) &&
         finite(state.angular_velocity_radps);
}

bool finite(const Ground& ground) {
  bool result = true;
  for (const WheelGround& wheel : ground)
    result &= finite(wheel.point_m) && finite(wheel.normal) && std::isfinite(wheel.friction) &&
              std::isfinite(wheel.rolling_resistance);
  return result;
}

/// The state after a bad step: its place and damage remain, and all motion is zero.
VehicleState halted(const VehicleState& state) {
  VehicleState result;
  result.world_from_body = state.world_from_body;
  result.steering = state.steering;
  result.powertrain.engine_radps = state.powertrain.engine_radps;
  result.powertrain.engine_running = state.powertrain.engine_running;
  for (int i = 0; i < wheel_count; ++i) result.wheels[i].damage = state.wheels[i].damage;
  result.bad_numbers = state.bad_numbers + 1;
  return result;
}

Vec3 origin_from_mass_centre(const BodyParameters& body) { return {-body.mass_centre_x_m, 0.0, -body.mass_centre_z_m}; }

}  // namespace

VehicleState standstill(const VehicleParameters& parameters, const RigidTransform& world_from_vehicle,
                        double speed_mps) {
  VehicleState state;
  const Quat& orientation = world_from_vehicle.orientation;
  state.world_from_body = {world_from_vehicle * -origin_from_mass_centre(parameters.body), orientation};
  state.velocity_mps = orientation * Vec3(speed_mps, 0.0, 0.0);
  const Statics known = statics(parameters);
  for (int i = 0; i < wheel_count; ++i) {
    const double deflection_m = parameters.tyre.radius_m - known.centre_z_m[axle_of(i)];
    const double effective_m = parameters.tyre.radius_m - (parameters.tyre.published ? 0.0 : deflection_m / 3.0);
    state.wheels[i].spin_radps = speed_mps / effective_m;
    state.wheels[i].squeeze_m = deflection_m;
    state.wheels[i].force_n.z = deflection_m * parameters.tyre.vertical_stiffness_npm;
  }
  const PowertrainParameters& powertrain = parameters.powertrain;
  state.powertrain.engine_radps = powertrain.idle_radps;
  if (powertrain.transmission != Transmission::direct && speed_mps > 1.0) {
    const double output_radps = output_shaft_radps(parameters, state);
    const int gear = cruising_gear(powertrain, output_radps);
    state.powertrain.gear = state.powertrain.next_gear = static_cast<std::int8_t>(gear);
    state.powertrain.engine_radps =
        std::clamp(output_radps * powertrain.gear_ratio[gear - 1], powertrain.idle_radps, powertrain.most_radps);
  }
  state.powertrain.since_shift_s = 10.0;
  return state;
}

void advance_vehicle(const VehicleParameters& parameters, const DriverInput& given, const Ground& ground, double dt_s,
                     VehicleState& state) {
  SEPTET_CHECK(dt_s > 0.0 && dt_s <= longest_step_s, "dt_s {}", dt_s);
  const VehicleState before = state;
  const DriverInput input = bounded(given);
  const Vec3 velocity_mps = glm::conjugate(state.world_from_body.orientation) * state.velocity_mps;
  ChassisInput chassis;
  chassis.steer_rad = advance_steering(parameters, input.steering_wheel_rad, velocity_mps.x, dt_s, state);
  chassis.drive_torque_nm = advance_powertrain(parameters, input, velocity_mps.x, dt_s, state);
  chassis.brake_torque_nm = advance_brakes(parameters, input, velocity_mps, dt_s, state);
  advance_chassis(parameters, chassis, ground, dt_s, state);
  if (!finite(ground) || !finite(state)) state = halted(before);
}

std::array<Vec3, wheel_count> wheel_centres_m(const VehicleParameters& parameters, const VehicleState& state) {
  const Statics known = statics(parameters);
  std::array<Vec3, wheel_count> result;
  for (int i = 0; i < wheel_count; ++i)
    result[i] =
        state.world_from_body * place_wheel(parameters, known, i, state.wheels[i], state.wheels[i].steer_rad).centre_m;
  return result;
}

VehicleOutputs outputs(const VehicleParameters& parameters, const VehicleState& state) {
  VehicleOutputs result;
  const Quat& world_from_body = state.world_from_body.orientation;
  const Vec3 origin_m = origin_from_mass_centre(parameters.body);
  const Vec3& omega = state.angular_velocity_radps;
  result.world_from_vehicle = {state.world_from_body * origin_m, world_from_body};
  result.velocity_mps = state.velocity_mps + world_from_body * glm::cross(omega, origin_m);
  result.acceleration_mps2 =
      state.acceleration_mps2 + world_from_body * (glm::cross(state.angular_acceleration_radps2, origin_m) +
                                                   glm::cross(omega, glm::cross(omega, origin_m)));
  result.angular_velocity_radps = world_from_body * omega;

  const Vec3 forward = world_from_body * Vec3(1, 0, 0);
  const Vec3 left = world_from_body * Vec3(0, 1, 0);
  const Vec3 velocity_mps = glm::conjugate(world_from_body) * state.velocity_mps;
  result.speed_mps = velocity_mps.x;
  result.yaw_rate_radps = result.angular_velocity_radps.z;
  const double heading = std::atan2(forward.y, forward.x);
  const Vec2 ahead{std::cos(heading), std::sin(heading)};
  const Vec2 acceleration{state.whole_acceleration_mps2};
  result.longitudinal_acceleration_mps2 = glm::dot(acceleration, ahead);
  result.lateral_acceleration_mps2 = ahead.x * acceleration.y - ahead.y * acceleration.x;
  result.specific_force_mps2 =
      glm::conjugate(world_from_body) * (state.acceleration_mps2 + Vec3(0.0, 0.0, gravity_mps2));
  const Vec2 level_mps{state.velocity_mps};
  if (glm::length(level_mps) > 1.0)
    result.sideslip_rad =
        std::atan2(ahead.x * level_mps.y - ahead.y * level_mps.x, std::abs(glm::dot(level_mps, ahead)));
  result.roll_rad = std::asin(std::clamp(left.z, -1.0, 1.0));
  result.pitch_rad = -std::asin(std::clamp(forward.z, -1.0, 1.0));
  result.engine_radps = state.powertrain.engine_radps;
  result.gear = state.powertrain.gear;
  result.steering_torque_nm = state.steering.torque_nm;
  result.front_steer_rad = 0.5 * (state.wheels[0].steer_rad + state.wheels[1].steer_rad);
  result.wheel_spin_rad = state.wheels[2].spin_rad;
  result.wheel_spin_radps = 0.5 * (state.wheels[2].spin_radps + state.wheels[3].spin_radps);
  for (int i = 0; i < wheel_count; ++i) {
    result.wheel_lift_m[i] = state.wheels[i].travel_m;
    result.wheel_load_n[i] = state.wheels[i].force_n.z;
    result.anti_lock_active |= state.brakes.pedal > 0.05 && state.brakes.release[i] > 0.05;
    result.stability_control_active |= std::abs(state.brakes.stabilising[i]) > 0.05;
  }
  return result;
}

}  // namespace septet::vehicle
