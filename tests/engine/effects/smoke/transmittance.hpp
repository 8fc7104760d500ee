#pragma once
/// How much is seen through the smoke of a grid: pictures are drawn of puffs instead.

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/effects/smoke/smoke_state.hpp"

namespace septet::smoke {

/// Share of the light that passes from one place of the world to the other, 0 to 1: exp(−∫ extinction ds) along the line (Beer and
/// Lambert). Walls do not count.
inline double transmittance(const State& state, const Vec3& from_m, const Vec3& to_m) {
  const Grid& grid = state.grid;
  const Vec3 from = grid.grid_from_world(from_m), way = grid.grid_from_world(to_m) - from;
  const int count[3] = {grid.nx, grid.ny, grid.nz};
  // The part of the line that is inside the grid.
  double enter = 0.0, leave = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    if (way[axis] == 0.0) {
      if (!(from[axis] >= 0.0 && from[axis] < count[axis])) return 1.0;
      continue;
    }
    const double a = -from[axis] / way[axis], b = (count[axis] - from[axis]) / way[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (!(enter < leave)) return 1.0;
  // From face to face of the cells (Amanatides and Woo 1987).
  int cell[3], step[3];
  double next[3], per_cell[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double at = from[axis] + enter * way[axis];
    cell[axis] = std::clamp(static_cast<int>(std::floor(at)), 0, count[axis] - 1);
    step[axis] = way[axis] > 0.0 ? 1 : -1;
    const double face = cell[axis] + (step[axis] > 0 ? 1 : 0);
    per_cell[axis] = way[axis] == 0.0 ? 0.0 : 1.0 / std::abs(way[axis]);
    next[axis] = way[axis] == 0.0 ? std::numeric_limits<double>::infinity() : (face - from[axis]) / way[axis];
  }
  double sum = 0.0, at = enter;
  while (at < leave) {
    const int axis = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    const double until = std::min(next[axis], leave);
    sum += std::max(0.0, until - at) * state.extinction_area_m2[grid.index(cell[0], cell[1], cell[2])];
    at = until;
    cell[axis] += step[axis];
    if (cell[axis] < 0 || cell[axis] >= count[axis]) break;
    next[axis] += per_cell[axis];
  }
  const double length_m = glm::length(way) * grid.cell_m;
  return std::exp(-sum * length_m / (grid.cell_m * grid.cell_m * grid.cell_m));
}

}  // namespace septet::smoke
