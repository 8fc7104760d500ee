#pragma once
/// Black ice on a lane: where it is, for the wheels that roll over it and for those who draw it.

#include <optional>

#include "engine/effects/ice/still_ice.hpp"
#include "engine/road/road_position.hpp"

namespace septet::simulation {

/// A stretch of a lane that is under ice, within its borders.
struct BlackIce {
  road::RoadIndex road = 0;
  std::int32_t lane = 0;
  double s_m = 0.0, length_m = 0.0;
  double thickness_m = 0.004;  ///< At first.
};

/// Where its edges lie at a station, in t: it freezes outwards from where water stood, and narrows towards its ends.
/// Nothing off its ends, and where the road has no such lane.
struct IceEdges {
  double right_t_m = 0.0, left_t_m = 0.0;
};
std::optional<IceEdges> edges_at(const road::RoadNetwork& roads, const BlackIce& ice, double s_m);

/// Whether a place of the road is under what is left of it.
bool is_iced(const road::RoadNetwork& roads, const BlackIce& ice, double thawed_kh, const road::RoadPosition& place);

/// As it is drawn.
ice::Sheet sheet_of(const road::RoadNetwork& roads, const BlackIce& ice);

}  // namespace septet::simulation
