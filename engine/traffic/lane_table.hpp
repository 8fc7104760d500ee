#pragma once
/// Drivable stretches of each lane of a corridor: looked up once, so that no vehicle queries the road network again.

#include <vector>

#include "engine/traffic/corridor.hpp"

namespace septet::traffic {

/// A stretch of one lane from begin to end. An end that is the corridor's own is infinite: the lane
/// does not end, the corridor does (or it is a ring).
struct OpenStretch {
  double begin_m = 0.0, end_m = 0.0;
};

/// The middle of a lane in the road's own t, and its shift along s; the last is 0 where the road was queried.
struct LaneCentre {
  double t_m = 0.0, slope = 0.0, slope_by_s = 0.0;
};

/// One lane's middle as it is driven: cubic between knots of which each has its place and slope, so that the corner
/// where a lane begins to narrow is rounded. Where that would be off by more than a decimetre (a lane begins at full
/// width, a road ends) the road is queried.
struct CentreLine {
  struct Knot {
    double t_m = 0.0, slope_by_x = 0.0;
    bool smooth = false;  ///< From here to the next knot.
  };
  std::vector<Knot> knots;  ///< Every `knot_step_m` of x.
};

struct LaneTable {
  static constexpr double knot_step_m = 10.0;

  int lowest = 1, highest = 0;                 ///< Lane numbers that are open anywhere along most of the corridor,
                                               ///< and anywhere at all.
  double lane_width_m = 3.5;                   ///< Width of the lowest lane at the corridor's middle.
  std::vector<std::vector<OpenStretch>> open;  ///< [lane number], ascending, apart.
  std::vector<CentreLine> centres;             ///< [lane number]
};

LaneTable make_lane_table(const road::RoadNetwork& network, const Corridor& corridor);

/// The middle of lane `lane` at x, which lies on `piece` and within the corridor; of the outermost
/// lane where the road has no such lane.
LaneCentre lane_centre(const road::RoadNetwork& network, const LaneTable& table, const CorridorPiece& piece, double x_m,
                       int lane);

/// The lane's middle at any x, along travel: to the left of the reference line, and its slope by x.
LaneCentre lane_centre_along(const road::RoadNetwork& network, const Corridor& corridor, const LaneTable& table,
                             double x_m, int lane);

/// The x at which the lane ends for a vehicle at x: infinite if it goes on; less than x where the lane is not open.
double lane_end_m(const LaneTable& table, int lane, double x_m);

}  // namespace septet::traffic
