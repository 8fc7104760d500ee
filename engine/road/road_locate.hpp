#pragma once
/// The inverse map: from a world point to the road, its (s, t) and its lanes; and the height of the surface there.
///
/// Exact: s and t solve the forward map of road_position.hpp to 1e-9 m. With a hint (the point's last position) the
/// search begins there, follows the links at a road's end and costs a few hundred nanoseconds; without one it walks the
/// network's tree of boxes. Pure functions; safe from many threads.

#include <optional>
#include <vector>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_position.hpp"

namespace septet::road {

struct Location {
  RoadPosition position;
  LanesAt lanes;  ///< lanes.outside_m includes the distance of the point beyond the road's ends.
};

/// The road that contains the point, else the nearest within `reach_m` of its lanes. A hint keeps the result on the
/// hint's road while that contains the point, which tells roads apart that cross or overlap. With a world z, `level_m`,
/// roads whose surface lies more than `level_reach_m` over or under it count only where there is no other: a wheel that
/// leaves a lane below a bridge is not on the bridge.
std::optional<Location> locate(const RoadNetwork& network, const Vec2& world_m, const RoadPosition* hint = nullptr,
                               double reach_m = 20.0, std::optional<double> level_m = std::nullopt);
inline constexpr double level_reach_m = 3.0;

/// All roads whose lanes contain the point: in a junction several overlap. Each once, except one that turns over itself. In
/// the order of the network's tree.
std::vector<Location> roads_holding(const RoadNetwork& network, const Vec2& world_m);

/// The point of the surface above or below a world point.
struct SurfacePoint {
  RoadPosition position;
  double height_m = 0.0;       ///< World z.
  Vec3 normal{0.0, 0.0, 1.0};  ///< Unit, upwards.
  double outside_m = 0.0;      ///< Distance of the point outside the lanes, as Location's.
};
std::optional<SurfacePoint> surface_at(const RoadNetwork& network, const Vec2& world_m,
                                       const RoadPosition* hint = nullptr, double reach_m = 20.0,
                                       std::optional<double> level_m = std::nullopt);

/// Builds RoadNetwork::stretches and bounds from the roads. Called by the reader, and by code that builds a network by
/// hand.
void build_spatial_index(RoadNetwork& network);

}  // namespace septet::road
