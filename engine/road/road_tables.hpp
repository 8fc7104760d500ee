#pragma once
/// Forward and inverse map as tables of comma-separated values, for `septet road sample` and `septet road locate`.

#include <iosfwd>

#include "engine/core/expected.hpp"
#include "engine/road/road_network.hpp"

namespace septet::road {

/// Lines `road_id,lane_id,s_m,lane_offset_m` in, lines
/// `road_id,lane_id,s_m,lane_offset_m,x_m,y_m,z_m,heading_rad,pitch_rad,roll_rad,lane_width_m,curvature_per_m,t_m,drive_heading_rad`
/// out, each with a header line (the input's may be left out). heading is the reference line's; drive_heading is
/// heading + atan(dt/ds) of the lane's centre, turned by π where the lane runs against s. Stops at the first wrong
/// line.
Expected<void> sample_table(const RoadNetwork& network, std::istream& in, std::ostream& out);

/// Lines `x_m,y_m` in, lines `x_m,y_m,road_id,lane_id,s_m,t_m,lane_offset_m,lane_id_any,residual_m,s_true_m,t_true_m`
/// out; the fields after y stay empty where no road is within 20 m. s_true and t_true repeat s and t: the inverse is
/// exact. residual is the distance from the point to the forward map of the result.
Expected<void> locate_table(const RoadNetwork& network, std::istream& in, std::ostream& out);

}  // namespace septet::road
