#include "engine/physics/vehicle/vehicle_state.hpp"

namespace septet::vehicle {
namespace {
void add(StateHash& hash, const Vec3& v) {
  hash.add(v.x);
  hash.add(v.y);
  hash.add(v.z);
}
}  // namespace

void hash_state(StateHash& hash, const VehicleState& state) {
  add(hash, state.world_from_body.position_m);
  const Quat& q = state.world_from_body.orientation;
  for (const double part : {q.w, q.x, q.y, q.z}) hash.add(part);
  add(hash, state.velocity_mps);
  add(hash, state.angular_velocity_radps);
  for (const WheelState& wheel : state.wheels)
    for (const double part : {wheel.travel_m, wheel.travel_rate_mps, wheel.spin_rad, wheel.spin_radps,
                              wheel.deflection_m.x, wheel.deflection_m.y})
      hash.add(part);
  hash.add(state.steering.column_rad);
  const PowertrainState& powertrain = state.powertrain;
  for (const double part : {powertrain.engine_radps, powertrain.engine_torque_nm, powertrain.clutch_nm,
                            powertrain.shift_s, powertrain.since_shift_s})
    hash.add(part);
  hash.add(int{powertrain.engine_running});
  hash.add(powertrain.gear);
  hash.add(powertrain.next_gear);
  hash.add(state.brakes.pedal);
  hash.add(state.brakes.torque_cut);
  hash.add(state.brakes.front_difference);
  for (int i = 0; i < wheel_count; ++i) {
    hash.add(state.brakes.release[i]);
    hash.add(state.brakes.stabilising[i]);
  }
  hash.add(state.bad_numbers);
  for (int i = 0; i < wheel_count; ++i) {  // Undamaged cars hash as those that cannot be damaged.
    const WheelDamage& damage = state.wheels[i].damage;
    if (!damage.any()) continue;
    hash.add(i);
    hash.add(damage.rim_bend_m);
    hash.add(damage.lost_air);
  }
}

}  // namespace septet::vehicle
