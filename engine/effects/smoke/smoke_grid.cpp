#include "engine/effects/smoke/smoke_grid.hpp"

#include "engine/core/check.hpp"

namespace septet::smoke {

Grid make_grid(const RigidTransform& world_from_grid, double cell_m, int nx, int ny, int nz, std::uint8_t open_faces) {
  for (const int n : {nx, ny, nz}) SEPTET_CHECK(n >= 1 && n <= max_cells_along, "{} by {} by {} cells", nx, ny, nz);
  SEPTET_CHECK(std::int64_t{nx} * ny * nz <= max_cells, "{} by {} by {} cells", nx, ny, nz);
  SEPTET_CHECK(std::isfinite(cell_m) && cell_m > 0.0, "cell of {} m", cell_m);
  Grid grid{world_from_grid, cell_m, nx, ny, nz, open_faces, {}};
  grid.wall.assign(static_cast<std::size_t>(grid.cells()), 0);
  return grid;
}

void add_walls(Grid& grid, const std::function<bool(const Vec3& world_m)>& is_wall) {
  for (int k = 0; k < grid.nz; ++k)
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i)
        if (is_wall(grid.world_from_cells({i + 0.5, j + 0.5, k + 0.5}))) grid.wall[grid.index(i, j, k)] = 1;
}

Grid make_tunnel_grid(const RigidTransform& world_from_floor_start, double cell_m, double length_m, double half_width_m,
                      double side_height_m, double crown_height_m) {
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
