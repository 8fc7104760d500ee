#pragma once
/// Look-ups in the cross-section of a road: sections, borders, widths, heights, lanes at a t, marks, limits.
///
/// All take a road of the network and a station in metres; a station outside the road is clamped to its nearest end.

#include <cstddef>
#include <cstdint>

#include "engine/road/road_network.hpp"
#include "engine/road/road_position.hpp"

namespace septet::road {

std::size_t section_index_at(const Road& road, double s_m);
inline const LaneSection& section_at(const Road& road, double s_m) {
  return road.sections[section_index_at(road, s_m)];
}

/// t of the border on the far side of `lane` from the centre; of lane 0: of the centre line (lane offset).
double outer_border_t_m(const Road& road, const LaneSection& section, int lane, double s_m);

/// t and dt/ds of both borders of a lane; `inner` is the border nearer to the centre line.
struct LaneBorders {
  double inner_t_m = 0.0, outer_t_m = 0.0;
  double inner_slope = 0.0, outer_slope = 0.0;

  double width_m() const { return outer_t_m > inner_t_m ? outer_t_m - inner_t_m : inner_t_m - outer_t_m; }
  double centre_t_m() const { return 0.5 * (inner_t_m + outer_t_m); }
  double centre_slope() const { return 0.5 * (inner_slope + outer_slope); }
};
LaneBorders lane_borders(const Road& road, const LaneSection& section, int lane, double s_m);

/// Width of a lane at a station; 0 where the road has no such lane there.
double lane_width_m(const RoadNetwork& network, RoadIndex road, int lane, double s_m);
/// Type of a lane at a station; none where the road has no such lane there.
LaneType lane_type(const RoadNetwork& network, RoadIndex road, int lane, double s_m);

/// Height of the surface over the road's plane (lane height, lateral shape, crossfall) at (s, t).
double surface_offset_m(const Road& road, double s_m, double t_m);

/// t of the outermost borders.
struct RoadExtent {
  double right_t_m = 0.0, left_t_m = 0.0;
};
RoadExtent road_extent(const Road& road, double s_m);

/// The bridge or tunnel that holds this place of the road, its ends included; null where none does.
const RoadStructure* structure_at(const Road& road, double s_m, RoadStructure::Kind kind);

/// The lanes at (s, t). A lane without width there does not count; a border belongs to the first lane that contains it.
struct LanesAt {
  int lane = 0;  ///< The drivable lane that contains the point, else the drivable lane with the nearest centre; 0:
                 ///< there is none.
  int lane_any_type = 0;   ///< The lane of any type that contains the point, else the nearest.
  double offset_m = 0.0;   ///< t − centre of `lane`.
  double outside_m = 0.0;  ///< Distance of the point outside the outermost lanes; 0 inside.
};
LanesAt lanes_at(const Road& road, double s_m, double t_m);

/// Speed limit of a lane at a station: the lane's own, else that of the road's type; 0 where the file gives none.
double speed_limit_mps(const RoadNetwork& network, const LanePosition& position);

/// The mark on the outer border of a lane at a station, or nullptr.
const RoadMark* road_mark_at(const RoadNetwork& network, RoadIndex road, int lane, double s_m);

}  // namespace septet::road
