#pragma once
/// Fires of known power under a roof, and what is measured of their smoke.

#include <cmath>
#include <cstddef>

#include "engine/effects/smoke/smoke_state.hpp"
#include "tests/engine/effects/smoke/smoke_fixtures.hpp"

namespace septet::smoke {

/// A fire at a place of the grid: 0.1 g of soot a gram, 25 MJ/kg, 8.7 m²/g, 30 % radiated.
inline Emitter fire_of_power(const Vec3& place_m, double power_mw) {
  constexpr double births_per_s = 200.0;
  Emitter fire;
  fire.position_m = place_m;
  fire.radius_m = 1.2;
  fire.rate_per_s = births_per_s;
  fire.heat = 2.0;
  fire.cooling_s = 120.0;
  fire.sinking = 0.02;
  fire.lifetime_s = 0.0;
  fire.extinction_area_m2 = power_mw / 25.0 * 1000.0 * 0.1 * 8.7 / births_per_s;
  fire.warmth_j = 0.7 * power_mw * 1e6 / births_per_s;
  return fire;
}

inline Parameters under_a_roof() {
  Parameters parameters;
  parameters.roof_mirrors = true;
  parameters.speed_cells_per_s = 8.0;
  return parameters;
}

inline void burn(State& state, double seconds, double draught_mps) {
  for (int tick = 0; tick < static_cast<int>(seconds / step_s); ++tick)
    advance_smoke(state, Vec3(draught_mps, 0.0, 0.0), {}, step_s);
}

/// Mean extinction of the layer of cells k over slices [from, to).
inline double extinction_of(const State& state, int k, int from, int to) {
  double area_m2 = 0.0;
  for (int j = 0; j < state.grid.ny; ++j)
    for (int i = from; i < to; ++i) area_m2 += state.extinction_area_m2[state.grid.index(i, j, k)];
  return area_m2 / (state.grid.ny * (to - from));
}

/// Farthest slice on this side (±1) of the fire whose five metres under the roof have 0.3 1/m: a tenth of the layer's.
inline int reach_m(const State& state, int fire_m, int side) {
  int reach = 0;
  for (int i = fire_m; i >= 2 && i + 3 <= state.grid.nx; i += side)
    if (extinction_of(state, state.grid.nz - 1, i - 2, i + 3) > 0.3) reach = std::abs(i - fire_m);
  return reach;
}

}  // namespace septet::smoke
