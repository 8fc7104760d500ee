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

int mirrored_height(const Grid& grid, int i, int j, int k) {
  const auto is_free = [&](int at) { return grid.inside(i, j, at) && !grid.wall[grid.index(i, j, at)]; };
  if (is_free(k) || is_open(grid, i, j, k)) return k;
  for (const int way : {-1, 1})
    for (int deep = 1; deep <= 3; ++deep)
      if (is_free(k + way * deep)) {
        const int image = k + way * (2 * deep - 1);
        return is_free(image) ? image : k;
      }
  return k;
}

void add_walls(Grid& grid, const std::function<bool(const Vec3& world_m)>& is_wall) {
  for (int k = 0; k < grid.nz; ++k)
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i)
        if (is_wall(grid.world_from_cells({i + 0.5, j + 0.5, k + 0.5}))) grid.wall[grid.index(i, j, k)] = 1;
}

}  // namespace septet::smoke
