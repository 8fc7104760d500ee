#pragma once
/// The members of a running impact, for engine/core/archive.hpp.

#include "engine/core/archive.hpp"
#include "engine/physics/impact/engagement.hpp"

namespace septet::impact {

SEPTET_MEMBERS(Body, mass_kg, yaw_inertia_kgm2, mass_centre_m, velocity_mps, yaw_rate_radps, heading_rad)
SEPTET_MEMBERS(Impulse, on_second_ns, first_arm_m, second_arm_m, normal_ns, tangential_ns, closing_mps, sliding_mps,
               stopped_mps, sticks)
SEPTET_MEMBERS(CrushPiece, depth_m, deceleration_mps2, steepness_ps2)
SEPTET_MEMBERS(CrushCurve, pieces, count)
SEPTET_MEMBERS(Ledger, kinetic_j, crush_j, friction_j)
SEPTET_MEMBERS(Pulse, impulse, normal, curve, restitution, compression_s, restitution_s, most_depth_m, age_s, ledger)
SEPTET_MEMBERS(Cut, way, offset_m)
SEPTET_MEMBERS(Cuts, each, count)
SEPTET_MEMBERS(Engagement, pulses, first, second, ledger, given_ns, set_apart_m)

}  // namespace septet::impact
