#pragma once
/// Black ice on a lane: its outline, for the wheels that roll over it and for the pictures.

#include <optional>

#include "engine/effects/ice/still_ice.hpp"
#include "engine/road/road_position.hpp"

namespace septet::simulation {

/// A stretch of a lane under ice, within its borders.
struct BlackIce {
  road::RoadIndex road = 0;
  std::int32_t lane = 0;
  double s_m = 0.0, length_m = 0.0;
  double thickness_m = 0.004;  ///< Initial thickness.
};

/// Edges of the ice at a station, in t: it freezes outwards from standing water, and narrows towards its ends. Empty
/// beyond its ends, and where the road has no such lane.
struct IceEdges {
  double right_t_m = 0.0, left_t_m = 0.0;
};
std::optional<IceEdges> edges_at(const road::RoadNetwork& roads, const BlackIce& ice, double s_m);

/// True where the remaining ice covers a place of the road.
bool is_iced(const road::RoadNetwork& roads, const BlackIce& ice, double thawed_kh, const road::RoadPosition& place);

/// The ice as a sheet to be drawn.
ice::Sheet sheet_of(const road::RoadNetwork& roads, const BlackIce& ice);

}  // namespace septet::simulation
