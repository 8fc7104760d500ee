#pragma once
/// Lists of members (engine/core/archive.hpp) of drivers and parameters, for the savers of both kinds of traffic.

#include "engine/core/archive.hpp"
#include "engine/traffic/traffic.hpp"
#include "engine/world/people_errors.hpp"

namespace septet {
SEPTET_MEMBERS(PeopleErrorRates, per_hour)
}

namespace septet::traffic {

SEPTET_MEMBERS(FollowingParameters, desired_speed_mps, time_gap_s, acceleration_mps2, comfortable_braking_mps2,
               standstill_gap_m)
SEPTET_MEMBERS(LaneChangeParameters, politeness, threshold_mps2, keep_right_mps2, largest_braking_mps2, duration_s)
SEPTET_MEMBERS(Driver, following, lane_change, reaction_s)
SEPTET_MEMBERS(FollowingLaw, inverse_desired_speed, time_gap_s, acceleration_mps2, standstill_gap_m,
               half_inverse_root_ab, comfortable_braking_mps2)
SEPTET_MEMBERS(VehicleClass, model, share, middle, temperament_spread)
SEPTET_MEMBERS(TrafficParameters, classes, count, radius_m, opposite_share, exit_share, decision_interval_s, first_id,
               worsened, errors)

}  // namespace septet::traffic
