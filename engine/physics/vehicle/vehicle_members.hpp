#pragma once
/// The members of the car's state, for engine/core/archive.hpp.

#include "engine/core/archive.hpp"
#include "engine/math/transform_members.hpp"
#include "engine/physics/impact/impact_members.hpp"
#include "engine/physics/vehicle/hull.hpp"
#include "engine/physics/vehicle/vehicle_state.hpp"

namespace septet::vehicle {

SEPTET_MEMBERS(WheelDamage, rim_bend_m, lost_air)
// Force and aligning torque of the last step bend the suspension in the next one; the other outputs are only reported.
SEPTET_MEMBER_GROUPS(WheelState, hashed(travel_m, travel_rate_mps, spin_rad, spin_radps, deflection_m, damage),
                     kept(squeeze_m), hashed(force_n, aligning_nm), kept(steer_rad, slip, slip_angle_rad))
SEPTET_MEMBERS(SteeringState, column_rad, torque_nm)
SEPTET_MEMBERS(PowertrainState, engine_radps, engine_torque_nm, engine_running, clutch_nm, gear, next_gear, shift_s,
               since_shift_s)
SEPTET_MEMBERS(BrakeState, pedal, release, stabilising, front_difference, torque_cut)
SEPTET_MEMBERS(VehicleState, world_from_body, velocity_mps, angular_velocity_radps, wheels, steering, powertrain,
               brakes, acceleration_mps2, whole_acceleration_mps2, angular_acceleration_radps2, bad_numbers)
SEPTET_MEMBERS(HullTouch, run, kind, point_m, normal, velocity_mps, angular_velocity_radps, closing_speed_mps, mass_kg,
               engagement, crushed_m, delta_v_mps, age_s, free_s, side, over)
SEPTET_MEMBERS(HullState, crush_m, touches)

}  // namespace septet::vehicle
