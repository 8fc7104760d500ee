#include "engine/physics/vehicle/gear_choice.hpp"

#include <algorithm>

#include "engine/physics/vehicle/controls.hpp"

namespace septet::vehicle {
namespace {

constexpr double least_time_between_shifts_s = 0.7;

double at_pedal(double closed, double open, double pedal) { return closed + pedal * (open - closed); }

/// One gear up or down where the input shaft runs outside its band for this pedal.
int automatic_gear(const PowertrainParameters& powertrain, int gear, double pedal, double output_radps) {
  if (gear < 1) return 1;
  const double up = at_pedal(powertrain.upshift_closed_radps, powertrain.upshift_open_radps, pedal * pedal);
  const double down = at_pedal(powertrain.downshift_closed_radps, powertrain.downshift_open_radps, pedal * pedal);
  const double input_radps = output_radps * powertrain.gear_ratio[gear - 1];
  if (gear < powertrain.gear_count && input_radps > up) return gear + 1;
  if (gear > 1 && input_radps < down && output_radps * powertrain.gear_ratio[gear - 2] < 0.93 * up) return gear - 1;
  return gear;
}

int wanted_gear(const PowertrainParameters& powertrain, const DriverInput& input, double pedal, double output_radps,
                const PowertrainState& state) {
  switch (input.selector) {
    case GearSelector::park:
    case GearSelector::neutral:
      return 0;
    case GearSelector::reverse:
      return -1;
    case GearSelector::manual:
      return std::clamp<int>(input.gear, -1, powertrain.gear_count);
    case GearSelector::drive:
      break;
  }
  if (state.since_shift_s < least_time_between_shifts_s && state.gear >= 1) return state.gear;
  return automatic_gear(powertrain, state.gear, pedal, output_radps);
}

}  // namespace

int direct_gear(const DriverInput& input) {
  switch (input.selector) {
    case GearSelector::park:
    case GearSelector::neutral:
      return 0;
    case GearSelector::reverse:
      return -1;
    case GearSelector::drive:
      return 1;
    case GearSelector::manual:
      break;
  }
  return input.gear > 0 ? 1 : input.gear < 0 ? -1 : 0;
}

void advance_gear(const PowertrainParameters& powertrain, const DriverInput& input, double pedal, double output_radps,
                  bool reverse_allowed, bool forward_allowed, double dt_s, PowertrainState& state) {
  state.since_shift_s = std::min(state.since_shift_s + dt_s, 10.0);
  if (state.next_gear != state.gear) {
    state.shift_s += dt_s;
    if (state.shift_s < powertrain.shift_time_s) return;
    state.gear = state.next_gear;
    state.since_shift_s = 0.0;
    return;
  }
  int gear = wanted_gear(powertrain, input, pedal, output_radps, state);
  // Against the motion no gear engages, but an engaged one stays: a car that rolls back on a hill is pulled up it
  // again.
  const bool fresh = gear * state.gear <= 0;
  if (fresh && ((gear < 0 && !reverse_allowed) || (gear > 0 && !forward_allowed))) gear = 0;
  // A gear that would run the engine past its limit is refused, and so is one with the clutch closed.
  if (gear >= 1 && output_radps * powertrain.gear_ratio[gear - 1] > powertrain.most_radps && gear < state.gear)
    gear = state.gear;
  const bool clutch_needed =
      powertrain.transmission == Transmission::manual && input.selector == GearSelector::manual && gear != 0;
  if (clutch_needed && input.clutch < 0.5) gear = state.gear;
  if (gear == state.gear) return;
  // In and out of neutral without delay; between two gears the shift takes its time.
  state.next_gear = static_cast<std::int8_t>(gear);
  state.shift_s = 0.0;
  if (gear == 0 || state.gear == 0 || gear * state.gear < 0) {
    state.gear = state.next_gear;
    state.since_shift_s = 0.0;
  }
}

int cruising_gear(const PowertrainParameters& powertrain, double output_radps) {
  int gear = 1;
  for (int next = 2; next <= powertrain.gear_count; ++next) gear = automatic_gear(powertrain, gear, 0.1, output_radps);
  return gear;
}

}  // namespace septet::vehicle
