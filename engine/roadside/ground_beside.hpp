#pragma once
/// Ground beside the roads for wheels: the land as it is drawn, everywhere, static.
///
/// It falls from the road's edge into the land over the width of the verge; farther out it is the grid of the drawn
/// land, bilinear between its corners. Ditches are drawn but have no effect: the transition into the land is one even
/// bank. Unevenness of a meadow lies on it (ISO 8608: a sum of waves of the class's density, between 1 and 20 m long,
/// in all directions), for which the drawn grid is too coarse. Beside a lower road it is no higher than earth stands
/// (lane_levels.hpp).
///
/// Pure functions; safe from many threads. World frame, metres.

#include <optional>

#include "engine/road/road_network.hpp"
#include "engine/road/road_position.hpp"
#include "engine/roadside/terrain.hpp"

namespace septet::roadside {

/// Properties of grass; values with their sources: ground_beside.toml.
struct GroundCover {
  double friction = 0.0;            ///< Peak coefficient, dry.
  double rolling_resistance = 1.0;  ///< Multiple of the rolling resistance of asphalt.
  double roughness_m3 = 0.0;        ///< Displacement power spectral density at 0.1 cycles/m.
};
const GroundCover& meadow();

/// Distance from the lanes within which the ground is level across and paved, as the road is.
inline constexpr double paved_edge_m = 0.7;

struct GroundBeside {
  double height_m = 0.0;
  Vec3 normal{0.0, 0.0, 1.0};  ///< Unit, upwards.
};

/// Ground at a point outside the lanes. `hint`: a place on a road near it, or null; `level_m`: a world z near the
/// ground, which distinguishes a road from the one below it.
GroundBeside ground_beside(const road::RoadNetwork& roads, const Terrain& terrain, const Vec2& p,
                           const road::RoadPosition* hint, std::optional<double> level_m = std::nullopt);

/// Height of the meadow's unevenness at a point, over the drawn land.
double unevenness_m(const Vec2& p);

}  // namespace septet::roadside
