#include "engine/effects/smoke/visibility.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "engine/sight/air.hpp"

namespace septet::smoke {
namespace {

/// Calls visit(cell, from, to) for the cells along the line from one place to the other, `from` and `to` as shares of its
/// length, until it returns false.
template <typename Visit>
void follow_line(const State& state, const Vec3& from_m, const Vec3& to_m, const Visit& visit) {
  const Grid& grid = state.grid;
  const Vec3 from = grid.grid_from_world(from_m), way = grid.grid_from_world(to_m) - from;
  const int count[3] = {grid.nx, grid.ny, grid.nz};
  // The part of the line that is inside the grid.
  double enter = 0.0, leave = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    if (way[axis] == 0.0) {
      if (!(from[axis] >= 0.0 && from[axis] < count[axis])) return;
      continue;
    }
    const double a = -from[axis] / way[axis], b = (count[axis] - from[axis]) / way[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (!(enter < leave)) return;
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
  double at = enter;
  while (at < leave) {
    const int axis = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    const double until = std::min(next[axis], leave);
    if (!visit(grid.index(cell[0], cell[1], cell[2]), at, std::max(at, until))) return;
    at = until;
    cell[axis] += step[axis];
    if (cell[axis] < 0 || cell[axis] >= count[axis]) return;
    next[axis] += per_cell[axis];
  }
}

double cell_m3(const State& state) { return state.grid.cell_m * state.grid.cell_m * state.grid.cell_m; }

}  // namespace

double extinction_per_m(const State& state, const Vec3& world_m) {
  const Grid& grid = state.grid;
  const Vec3 p = glm::floor(grid.grid_from_world(world_m));
  if (!(p.x >= 0.0 && p.y >= 0.0 && p.z >= 0.0 && p.x < grid.nx && p.y < grid.ny && p.z < grid.nz)) return 0.0;
  const int cell = grid.index(static_cast<int>(p.x), static_cast<int>(p.y), static_cast<int>(p.z));
  return state.extinction_area_m2[cell] / cell_m3(state);
}

std::optional<double> visibility_m(double extinction_per_m, bool shines) {
  if (!(extinction_per_m > 0.0)) return std::nullopt;
  return sight::visible_depth(shines) / extinction_per_m;
}

double optical_depth(const State& state, const Vec3& from_m, const Vec3& to_m) {
  double shares_m2 = 0.0;
  follow_line(state, from_m, to_m, [&](int cell, double from, double to) {
    shares_m2 += (to - from) * static_cast<double>(state.extinction_area_m2[cell]);
    return true;
  });
  return shares_m2 * glm::length(to_m - from_m) / cell_m3(state);
}

double transmittance(const State& state, const Vec3& from_m, const Vec3& to_m) {
  return std::exp(-optical_depth(state, from_m, to_m));
}

std::optional<double> distance_of_depth_m(const State& state, const Vec3& from_m, const Vec3& to_m, double depth) {
  const double length_m = glm::length(to_m - from_m), per_share = length_m / cell_m3(state);
  double sum = 0.0;
  std::optional<double> distance_m;
  follow_line(state, from_m, to_m, [&](int cell, double from, double to) {
    const double per = static_cast<double>(state.extinction_area_m2[cell]) * per_share, here = (to - from) * per;
    if (sum + here >= depth && here > 0.0) {
      distance_m = (from + (depth - sum) / per) * length_m;
      return false;
    }
    sum += here;
    return true;
  });
  return distance_m;
}

}  // namespace septet::smoke
