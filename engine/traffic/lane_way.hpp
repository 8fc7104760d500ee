#pragma once
/// Lengths and speeds of a corridor's lanes: looked up once.
///
/// x counts along the reference line (corridor.hpp). A lane beside it is longer outside a bend and shorter inside, by 1
/// − κt a metre of x, and longer on a grade. Speeds, gaps and headways are those of the lane (SAE J2944: along the path
/// of travel); only places are in x. Immutable once built; pure functions. Metres of the lane, metres a second squared
/// for speeds.
///
/// Speed: the posted limit (OpenDRIVE 1.8, 10.3 and 11.9: of the road's type, or the lane's own) and the speed in bends
/// at `bend_mps2` sideways; ahead of either, the speed from which braking with `ease_off_mps2` leads down to it. 2 m/s²
/// sideways is the side friction of 0.19 to 0.21 at which road users are comfortable at 50 km/h (AASHTO, "A Policy on
/// Geometric Design of Highways and Streets", 2011, table 3-7); 1.5 m/s² is the comfortable braking of drivers who see
/// the reason from afar (Treiber and Kesting, "Traffic Flow Dynamics", 2013, table 11.2).

#include <cstddef>
#include <vector>

#include "engine/traffic/corridor.hpp"
#include "engine/traffic/lane_table.hpp"
#include "engine/traffic/line_table.hpp"

namespace septet::traffic {

inline constexpr double bend_mps2 = 2.0, ease_off_mps2 = 1.5;

struct LaneWay {
  static constexpr double step_m = 5.0;

  double stretch = 1.0;  ///< Metres of the lane's middle a metre of x; at the ends of `way_m` where that is set.
  /// Path length from the corridor's begin, every `step_m` of x; empty: the same stretch everywhere.
  std::vector<double> way_m;
  /// Square of the allowed speed, every `step_m` of x, linear between; empty: unbounded.
  std::vector<double> allowed_m2ps2;       ///< Bound by bends and limits.
  std::vector<double> bend_allowed_m2ps2;  ///< Bound by bends alone, for vehicles exempt from limits.
};

struct LaneWays {
  bool straight = true;        ///< Straight and level from begin to end: every lane is as long as the line.
  std::vector<LaneWay> lanes;  ///< [lane number]
};

LaneWays make_lane_ways(const road::RoadNetwork& network, const Corridor& corridor, const LaneTable& table,
                        const LineTable& line);

/// Path length from the corridor's begin; beyond an end as at that end.
double way_at_m(const LaneWay& way, double x_m);
/// Path length from → to along the lane, negative if `to_x_m` lies behind; on a ring always ahead.
inline double way_between_m(const Corridor& corridor, const LaneWay& way, double from_x_m, double to_x_m) {
  const double d = to_x_m - from_x_m;
  const bool round = corridor.closed && d < 0.0;
  if (way.way_m.empty()) return (round ? d + corridor.length_m : d) * way.stretch;
  const double along = way_at_m(way, to_x_m) - way_at_m(way, from_x_m);
  return round ? along + way_at_m(way, corridor.length_m) : along;
}

/// The line at (s, t) of constant t, by a metre of s in the road's frame: forward and, where the road climbs or tilts,
/// up.
struct LineTangent {
  double forward = 1.0, up = 0.0;
  double stretch = 1.0;  ///< Its length; at least 0.05, where a bend is as tight as the lane is wide.
};
LineTangent tangent_at(const road::Road& road, const RoadLine& line, double s_m, double t_m);

/// Allowed speed at x; infinite where it is unbounded. `is_exempt`: of posted limits.
double allowed_speed_mps(const LaneWay& way, double x_m, bool is_exempt);
/// Greatest acceleration within that speed, braking before it falls; infinite where it is unbounded.
double allowed_acceleration_mps2(const LaneWay& way, double x_m, double speed_mps, bool is_exempt);

}  // namespace septet::traffic
