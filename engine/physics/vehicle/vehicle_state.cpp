#include "engine/physics/vehicle/vehicle_state.hpp"

#include "engine/physics/vehicle/vehicle_members.hpp"

namespace septet::vehicle {

void hash_state(StateHash& hash, const VehicleState& state) { hash_members(hash, state); }

}  // namespace septet::vehicle
