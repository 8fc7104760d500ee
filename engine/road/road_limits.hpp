#pragma once
/// Bounds of roads on earth. A number beyond is a mistake in the file, and refused with its line: code that builds from
/// a road need not check for it.

namespace septet::road {

/// Distance of a point from the plane's origin. Projected coordinates reach 2e7 m; with the number of a zone written in
/// front, 6e7 m.
constexpr double farthest_m = 1e8;
constexpr double highest_m = 2e4;  ///< Height of a road above or below 0.
/// Length of one road, and of all roads of a network together.
constexpr double longest_road_m = 1e6, longest_network_m = 2e7;
constexpr double widest_m = 1000.0;   ///< Width of a lane, and of a lane offset to either side.
constexpr double tallest_m = 1000.0;  ///< Height of the surface above the road's plane, and of a sign.
constexpr double largest_object_m = 1e4;
constexpr double steepest_roll_rad = 1.5;
constexpr double fastest = 1000.0;              ///< A speed limit, in any unit.
constexpr double largest_coefficient = 1000.0;  ///< Friction and roughness.
constexpr int most_lanes_of_a_side = 100;
/// A shorter dash cannot be painted, and closer repetitions are a continuous object.
constexpr double shortest_dash_m = 0.01, least_spacing_m = 0.1;

}  // namespace septet::road
