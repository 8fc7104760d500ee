#pragma once
/// Where each lane of a corridor can be driven on: looked up once, so that no vehicle asks the road
/// network again.

#include <vector>

#include "engine/traffic/corridor.hpp"

namespace septet::traffic {

/// A stretch of one lane from begin to end. An end that is the corridor's own is infinite: the lane
/// does not end, the corridor does (or it is a ring).
struct OpenStretch {
  double begin_m = 0.0, end_m = 0.0;
};

struct LaneTable {
  int lowest = 1, highest = 0;  ///< Lane numbers that are open anywhere along most of the corridor,
                                ///< and anywhere at all.
  double lane_width_m = 3.5;    ///< Of the lowest lane at the corridor's middle.
  std::vector<std::vector<OpenStretch>> open;  ///< [lane number], ascending, apart.
};

LaneTable make_lane_table(const road::RoadNetwork& network, const Corridor& corridor);

/// The x at which the lane ends for a vehicle at x: infinite if it goes on; less than x where the
/// lane is not open.
double lane_end_m(const LaneTable& table, int lane, double x_m);

}  // namespace septet::traffic
