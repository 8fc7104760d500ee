#pragma once
/// Member lists of the shared types of engine/world, for engine/core/archive.hpp.

#include "engine/core/archive.hpp"
#include "engine/math/transform_members.hpp"
#include "engine/world/driver_input.hpp"
#include "engine/world/snapshot.hpp"

namespace septet {

SEPTET_MEMBERS(Lamps, bits)
SEPTET_MEMBERS(Head, from_rest_m, turn_rad)
// The head moves pictures alone, not the world.
SEPTET_MEMBER_GROUPS(DriverInput,
                     hashed(steering_wheel_rad, accelerator, brake, clutch, selector, gear, indicator, hazard_lights,
                            horn, low_beam, high_beam, parking_brake, gaze_heading_rad, sequence),
                     kept(head))
SEPTET_MEMBERS(Environment, sun_azimuth_rad, sun_elevation_rad, sun_illuminance_lux, visibility_m, cloud_cover,
               rain_mm_per_h, road_wetness, snow_cover, temperature_k, wind_speed_mps, wind_direction_rad)
SEPTET_MEMBERS(GameStanding, level, end, points, survived_s, leader_m, away_s)
SEPTET_MEMBERS(EffectKeyframe, id, kind, data, tick)
// The lateness of input is not part of the input from which a drive is run again.
SEPTET_MEMBER_GROUPS(Diagnostics, hashed(bad_numbers, collisions), kept(input_stale_ticks))

}  // namespace septet
