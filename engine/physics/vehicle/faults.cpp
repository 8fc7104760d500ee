#include "engine/physics/vehicle/faults.hpp"

#include <algorithm>

namespace septet::vehicle {

VehicleParameters with_faults(const VehicleParameters& parameters, const Faults& faults) {
  VehicleParameters failed = parameters;
  if (faults.anti_lock)
    failed.brakes.anti_lock = failed.brakes.traction_control = failed.brakes.stability_control = false;
  if (faults.misfire) {
    PowertrainParameters& powertrain = failed.powertrain;
    const double firing = 1.0 - 1.0 / std::max(powertrain.cylinders, 2);
    Table& torque_nm = powertrain.full_torque_nm;
    for (std::size_t i = 0; i < torque_nm.count; ++i) {
      const double dragged_nm = powertrain.closed_torque_nm.held(torque_nm.x[i]);
      torque_nm.y[i] = dragged_nm + firing * (torque_nm.y[i] - dragged_nm);
    }
    powertrain.direct_acceleration_mps2 *= firing;
  }
  return failed;
}

void release_controls(VehicleState& state) {
  state.brakes.release = {};
  state.brakes.stabilising = {};
  state.brakes.torque_cut = 0.0;
}

void puncture(WheelState& wheel) {
  constexpr double least = 1e-3;  // The rest leaves by itself.
  wheel.damage.lost_air = std::max(wheel.damage.lost_air, least);
}

void change_tyre(WheelState& wheel) { wheel.damage = {}; }

}  // namespace septet::vehicle
