#pragma once
/// Visibility through smoke.
///
/// Extinction of a cell is the sum of its particles' cross-sections over its volume (1/m). A screen's picture uses the same cross-sections (smoke_keyframe.hpp).

#include <optional>

#include "engine/effects/smoke/smoke_state.hpp"

namespace septet::smoke {

/// 1/m at a place of the world; 0 outside the grid.
double extinction_per_m(const State& state, const Vec3& world_m);

/// Distance at which an object is seen through this extinction: 3 over it for reflecting ones, 8 over it for lamps and
/// lit signs (Jin, "Visibility through fire smoke"). Empty (unlimited) without smoke.
std::optional<double> visibility_m(double extinction_per_m, bool shines);

}  // namespace septet::smoke
