#include "engine/driver/warning.hpp"

#include <algorithm>
#include <cmath>

namespace septet::driver {
namespace {

constexpr double at_rest_mps = 0.3, driving_mps = 2.0;
constexpr double near_m = 40.0;

bool warns_ahead(const SeenVehicle& vehicle, int lane) {
  return vehicle.is_ahead && vehicle.innermost_lane <= lane && lane <= vehicle.outermost_lane &&
         vehicle.gap_m < near_m && vehicle.speed_mps < at_rest_mps && warns(vehicle);
}

}  // namespace

bool advance_warning(WarningState& state, const SpeedParameters& speed, const OwnPlace& own,
                     std::span<const SeenVehicle> vehicles, double dt_s, Random& random) {
  if (std::abs(own.speed_mps) > driving_mps) state = {};
  if (state.on || std::abs(own.speed_mps) > at_rest_mps) return state.on;
  if (std::ranges::none_of(vehicles, [&](const SeenVehicle& vehicle) { return warns_ahead(vehicle, own.lane); }))
    return false;
  if (!state.after_s) state.after_s = speed.warns_after_s * std::exp(speed.warns_spread * random.normal());
  state.stands_s += dt_s;
  state.on = state.stands_s >= *state.after_s;
  return state.on;
}

}  // namespace septet::driver
