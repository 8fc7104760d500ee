#pragma once
/// The grid of a road tunnel with an arch, for tests and benchmarks of smoke.

#include <cmath>

#include "engine/effects/smoke/smoke_grid.hpp"

namespace septet::smoke {

/// A tunnel along x of the grid: a box of this length whose cells outside the arch (half width, height of the side
/// walls, height of the crown over the floor; metres) are wall. Both portals are open.
inline Grid make_tunnel_grid(const RigidTransform& world_from_floor_start, double cell_m, double length_m,
                             double half_width_m, double side_height_m, double crown_height_m) {
  const auto cells = [&](double metres) { return static_cast<int>(std::ceil(metres / cell_m)); };
  const int across = 2 * cells(half_width_m);
  RigidTransform world_from_grid = world_from_floor_start;
  world_from_grid.position_m = world_from_floor_start * Vec3(0.0, -0.5 * across * cell_m, 0.0);
  Grid grid =
      make_grid(world_from_grid, cell_m, cells(length_m), across, cells(crown_height_m), open_x_low | open_x_high);
  const RigidTransform floor_from_world = inverse(world_from_floor_start);
  add_walls(grid, [&](const Vec3& world_m) {
    const Vec3 p = floor_from_world * world_m;
    // Upright sides, and half an ellipse above them.
    const double u = p.y / half_width_m;
    const double rise = crown_height_m - side_height_m;
    return std::abs(u) > 1.0 || p.z > side_height_m + rise * std::sqrt(1.0 - u * u);
  });
  return grid;
}

}  // namespace septet::smoke
