#pragma once
/// Lanes below ground that is drawn in rows of points beside a road.
///
/// A quad between two rows may be drawn as either pair of its triangles; a lane must lie below neither of all four.
/// Metres, world frame.

#include <array>
#include <cstddef>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "engine/scenery/world/world_context.hpp"

namespace septet::scenery {

/// Distance along a tile's own road from which a place belongs to another turn of it.
inline constexpr double over_itself_m = 40.0;

/// Place of a lane below one of the four triangles that a quad may be drawn as.
struct Covered {
  std::array<Vec3*, 3> corners;
  Vec3 shares;
  double most_m;
  std::size_t row, column;

  double excess_m() const {
    return shares.x * corners[0]->z + shares.y * corners[1]->z + shares.z * corners[2]->z - most_m;
  }
};

/// Places of lanes that the ground between these rows, one for each station, lies over. `among_roads`: lanes may be
/// narrow here, so that points between LaneLevels' places are tested too. The result points into `rows`.
std::vector<Covered> covered_lanes(const WorldContext& world, const RoadTile& tile, std::span<const double> along,
                                   std::vector<std::vector<Vec3>>& rows, bool among_roads);

/// Lowers the rows' points until they lie over no lane. Returns the quads, by row and column, for which that failed.
std::set<std::pair<std::size_t, std::size_t>> lower_below_lanes(const std::vector<Covered>& covered);

}  // namespace septet::scenery
