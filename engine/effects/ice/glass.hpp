#pragma once
/// Ice and impacts on a windscreen, as drawn: frost that warmth melts (frost.hpp), and stars of cracks that stay.
///
/// Both are surfaces without thickness on the pane, through which the world behind is seen. A pane is a grid of points,
/// so that it may be curved as its car's is.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/effects/ice/frost.hpp"
#include "engine/world/ice_vertex.hpp"

namespace septet::ice {

/// Place of an impact on the glass: cracks run out from there, and some around it.
struct Star {
  double across = 0.5, up = 0.5;  ///< Shares of the pane, as in frost.hpp.
  double reach_m = 0.4;           ///< Length of the longest crack.
  std::uint32_t seed = 0;
};

struct Pane {
  ParticipantId vehicle = 0;
  Frost frost;
  std::vector<Star> stars;
};

/// Length of the cracks of an impact at this speed: as its energy goes into their length, they grow with it. Assumed:
/// 35 mm for each metre a second, 0.9 m at most; none at walking pace.
inline constexpr double least_starring_mps = 4.0, crack_s = 0.035, longest_crack_m = 0.9;
Star star_of_blow(double across, double closing_mps, std::uint64_t seed);

/// Columns run from its right to its left, rows from its foot to its head.
struct PaneShape {
  std::size_t columns = 0, rows = 0;
  std::vector<Vec3> points_m;  ///< Row by row.

  bool empty() const { return columns < 2 || rows < 2; }
};
/// Shape between four corners, the middle forward of them by `bulge_m`.
PaneShape pane_between(const Vec3& foot_right_m, const Vec3& foot_left_m, const Vec3& head_right_m,
                       const Vec3& head_left_m, double bulge_m);
/// Shape on triangles of glass that look forward (+x), which are a windscreen's; empty where they do not form one.
PaneShape pane_on(std::span<const Vec3> triangles_m);

Vec3 place_on(const PaneShape& pane, double across, double up);
/// Length along the middle of its foot and head, and from foot to head.
double width_m(const PaneShape& pane);
double height_m(const PaneShape& pane);

/// Frost where some is left; rest_m: across and up in metres, from a place that its seed draws, and kg/m².
std::vector<IceVertex> frost_surface(const PaneShape& pane, const Frost& frost);
/// The cracks of a star, a millimetre or two wide, in strips thrice as wide; rest_m: metres along a crack, −1 to 1
/// across its strip, and 0. Where glass is crushed, places in metres, and 1 in the middle to 2 at the rim. Normals are
/// of the faces of the cracks, which stand steep in the glass.
std::vector<IceVertex> star_surface(const PaneShape& pane, const Star& star);

}  // namespace septet::ice
