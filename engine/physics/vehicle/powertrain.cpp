#include <algorithm>
#include <cmath>

#include "engine/physics/vehicle/controls.hpp"
#include "engine/physics/vehicle/gear_choice.hpp"

namespace septet::vehicle {
namespace {

constexpr double reverse_inhibit_mps = 2.0;
constexpr double winding_s = 0.02;  // Time constant of the driveline: a jolt of about 7 Hz when the clutch bites.

/// Shares of the drive torque; they are also the weights of the wheels' speeds in the differentials.
std::array<double, wheel_count> wheel_shares(const PowertrainParameters& powertrain) {
  const double front = 0.5 * powertrain.front_share, rear = 0.5 - front;
  return {front, front, rear, rear};
}

/// Gear ratio in force, blended while a shift is going on; negative in reverse, zero in neutral.
double ratio_of(const PowertrainParameters& powertrain, int gear) {
  if (gear == 0) return 0.0;
  return gear < 0 ? -powertrain.reverse_ratio : powertrain.gear_ratio[gear - 1];
}

/// Torque of the engine towards the demand of pedal, idle control and limiter.
double engine_torque_nm(const PowertrainParameters& powertrain, double pedal, double dt_s, PowertrainState& state) {
  const double speed = state.engine_radps;
  if (!state.engine_running) {
    state.engine_torque_nm = 0.0;
    return 0.0;  // Its friction is in spin_stalled.
  }
  const double idle = std::clamp((1.03 * powertrain.idle_radps - speed) / (0.2 * powertrain.idle_radps), 0.0, 0.7);
  const double limiter = std::clamp((1.01 * powertrain.most_radps - speed) / (0.02 * powertrain.most_radps), 0.0, 1.0);
  // Half-way open, a throttle plate already lets three quarters of the air in.
  const double throttle = limiter * std::max(pedal * (2.0 - pedal), idle);
  const double closed = powertrain.closed_torque_nm.held(speed);
  const double wanted = closed + throttle * (powertrain.full_torque_nm.held(speed) - closed);
  state.engine_torque_nm += (wanted - state.engine_torque_nm) * dt_s / (powertrain.torque_lag_s + dt_s);
  return state.engine_torque_nm;
}

/// Friction clutch of limited capacity between the engine and a shaft of `shaft_inertia`; implicit,
/// as it is stiff. `wound_nm`: the torque that the driveline holds without slip.
double clutch_torque_nm(double capacity_nm, double engine_nm, double slip_radps, double engine_inertia,
                        double shaft_inertia, double dt_s, double wound_nm = 0.0) {
  const double mobility = dt_s * (1.0 / engine_inertia + 1.0 / shaft_inertia);
  const double closing_nm = wound_nm + 0.8 * (slip_radps + dt_s * engine_nm / engine_inertia) / mobility;
  return std::clamp(closing_nm, -capacity_nm, capacity_nm);
}

/// Torque that a standing engine holds: friction, and the compression of a cylinder. Assumed: 15 N m for each, so that
/// 90 N m turn a three-litre six over, of the order of its starter's torque.
double standing_torque_nm(const PowertrainParameters& powertrain) {
  return 15.0 * powertrain.cylinders - powertrain.closed_torque_nm.held(0.0);
}

/// Speed of a stopped engine after one step with `load_nm` taken from it. Its friction only slows it. It never turns
/// backwards, as nothing behind it requires that.
double spin_stalled(const PowertrainParameters& powertrain, double engine_radps, double load_nm, double dt_s) {
  const double friction_nm =
      engine_radps < 1.0 ? standing_torque_nm(powertrain) : -powertrain.closed_torque_nm.held(engine_radps);
  const double free_radps = engine_radps - dt_s * load_nm / powertrain.engine_inertia_kgm2;
  const double most_radps = dt_s * friction_nm / powertrain.engine_inertia_kgm2;
  return std::max(0.0, free_radps - std::clamp(free_radps, -most_radps, most_radps));
}

struct Coupling {
  double engine_nm = 0.0;  ///< Taken from the engine.
  double input_nm = 0.0;   ///< Given to the gearbox.
};

Coupling converter(const PowertrainParameters& powertrain, double engine_radps, double input_radps) {
  const double pump = std::max(engine_radps, 1.0);
  const double speed_ratio = input_radps / pump;
  const double pump_nm = powertrain.converter_capacity.held(speed_ratio) * pump * pump;
  return {pump_nm, pump_nm * powertrain.converter_ratio.held(speed_ratio)};
}

double clutch_closed(const PowertrainParameters& powertrain, const DriverInput& input, const PowertrainState& state) {
  if (state.next_gear != state.gear || state.gear == 0) return 0.0;
  if (input.selector == GearSelector::manual) return std::clamp((0.75 - input.clutch) / 0.5, 0.0, 1.0);
  // The robot lets the clutch bite between idle and 1.8 times idle.
  return std::clamp((state.engine_radps / powertrain.idle_radps - 1.0) / 0.8, 0.0, 1.0);
}

void stall_or_start(const PowertrainParameters& powertrain, const DriverInput& input, PowertrainState& state) {
  if (state.engine_radps < 0.4 * powertrain.idle_radps) state.engine_running = false;
  const bool free = state.gear == 0 || input.clutch > 0.8 || powertrain.transmission == Transmission::automatic;
  if (!state.engine_running && free) {
    state.engine_running = true;  // The starter, without its second of noise.
    state.engine_radps = std::max(state.engine_radps, 0.8 * powertrain.idle_radps);
  }
}

}  // namespace

double output_shaft_radps(const VehicleParameters& parameters, const VehicleState& state) {
  const auto shares = wheel_shares(parameters.powertrain);
  double speed = 0.0;
  for (int i = 0; i < wheel_count; ++i) speed += shares[i] * state.wheels[i].spin_radps;
  return speed * parameters.powertrain.final_ratio;
}

std::array<double, wheel_count> advance_powertrain(const VehicleParameters& parameters, const DriverInput& input,
                                                   double speed_mps, double dt_s, VehicleState& vehicle) {
  const PowertrainParameters& powertrain = parameters.powertrain;
  PowertrainState& state = vehicle.powertrain;
  const auto shares = wheel_shares(powertrain);
  std::array<double, wheel_count> torque_nm{};
  const double pedal = input.accelerator * (1.0 - vehicle.brakes.torque_cut);

  if (powertrain.transmission == Transmission::direct) {
    state.gear = static_cast<std::int8_t>(direct_gear(input));
    const double fading = std::max(1.0, std::abs(speed_mps) / powertrain.direct_power_speed_mps);
    const double total_nm = state.gear * pedal * parameters.body.mass_kg * parameters.tyre.radius_m *
                            powertrain.direct_acceleration_mps2 / fading;
    for (int i = 0; i < wheel_count; ++i) torque_nm[i] = shares[i] * total_nm;
    return torque_nm;
  }

  const double output_radps = output_shaft_radps(parameters, vehicle);
  const bool reverse_allowed = speed_mps < reverse_inhibit_mps;
  const bool forward_allowed = speed_mps > -reverse_inhibit_mps;
  advance_gear(powertrain, input, pedal, output_radps, reverse_allowed, forward_allowed, dt_s, state);

  // While the gears change, the ratio glides and the engine gives half its torque.
  const bool shifting = state.next_gear != state.gear;
  const double part = shifting ? state.shift_s / powertrain.shift_time_s : 0.0;
  const double ratio = (1.0 - part) * ratio_of(powertrain, state.gear) + part * ratio_of(powertrain, state.next_gear);
  const double input_radps = ratio * output_radps;
  const double engine_nm = engine_torque_nm(powertrain, shifting ? 0.5 * pedal : pedal, dt_s, state);

  double wheel_inertia = 0.0;
  for (int i = 0; i < wheel_count; ++i)
    wheel_inertia += shares[i] > 0.0 ? parameters.suspension[i / 2].wheel_inertia_kgm2 : 0.0;
  const double gearing = ratio * powertrain.final_ratio;
  const double shaft_inertia = wheel_inertia / std::max(gearing * gearing, 1e-3);
  const double slip_radps = state.engine_radps - input_radps;

  Coupling coupling;
  if (powertrain.transmission == Transmission::manual) {
    double capacity = powertrain.clutch_capacity_nm * clutch_closed(powertrain, input, state);
    if (!state.engine_running && state.engine_radps < 1.0)  // A higher load turns it over.
      capacity = std::min(capacity, standing_torque_nm(powertrain));
    coupling.engine_nm = coupling.input_nm = clutch_torque_nm(
        capacity, engine_nm, slip_radps, powertrain.engine_inertia_kgm2, shaft_inertia, dt_s, state.clutch_nm);
    state.clutch_nm += (coupling.input_nm - state.clutch_nm) * dt_s / (winding_s + dt_s);
  } else if (ratio != 0.0) {
    coupling = converter(powertrain, state.engine_radps, input_radps);
    const bool locked = !shifting && powertrain.lowest_lockup_gear > 0 && state.gear >= powertrain.lowest_lockup_gear &&
                        state.since_shift_s > 0.3 && input_radps > powertrain.lockup_speed_radps;
    if (locked) {
      const double lock_nm = clutch_torque_nm(powertrain.clutch_capacity_nm, engine_nm - coupling.engine_nm, slip_radps,
                                              powertrain.engine_inertia_kgm2, shaft_inertia, dt_s);
      coupling.engine_nm += lock_nm;
      coupling.input_nm += lock_nm;
    }
  }
  if (state.engine_running)
    state.engine_radps =
        std::max(0.0, state.engine_radps + dt_s * (engine_nm - coupling.engine_nm) / powertrain.engine_inertia_kgm2);
  else
    state.engine_radps = spin_stalled(powertrain, state.engine_radps, coupling.engine_nm, dt_s);
  stall_or_start(powertrain, input, state);

  const bool driving = coupling.input_nm * input_radps >= 0.0;
  const double shaft_nm = coupling.input_nm * gearing * (driving ? powertrain.efficiency : 1.0 / powertrain.efficiency);
  for (int i = 0; i < wheel_count; ++i) torque_nm[i] = shares[i] * shaft_nm;
  return torque_nm;
}

}  // namespace septet::vehicle
