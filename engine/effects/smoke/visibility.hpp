#pragma once
/// Visibility through smoke.
///
/// Extinction of a cell is the sum of its particles' cross-sections over its volume (1/m). A line of sight adds it up
/// from cell to cell; a screen's picture uses the same cross-sections (smoke_keyframe.hpp). World frame, metres.

#include <optional>

#include "engine/effects/smoke/smoke_state.hpp"

namespace septet::smoke {

/// 1/m at a place of the world; 0 outside the grid.
double extinction_per_m(const State& state, const Vec3& world_m);

/// Distance at which an object is seen (sight::visible_depth) through this even extinction. Empty (unlimited) without smoke.
std::optional<double> visibility_m(double extinction_per_m, bool shines);

/// ∫ extinction ds along the line, from face to face of the cells (Amanatides and Woo 1987). Walls do not count.
double optical_depth(const State& state, const Vec3& from_m, const Vec3& to_m);
/// Share of the light that passes, 0 to 1: exp(−optical depth) (Beer and Lambert).
double transmittance(const State& state, const Vec3& from_m, const Vec3& to_m);
/// Distance from `from_m` at which the line has this optical depth behind it; empty where all of it has less.
std::optional<double> distance_of_depth_m(const State& state, const Vec3& from_m, const Vec3& to_m, double depth);

}  // namespace septet::smoke
