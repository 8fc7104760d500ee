#include "engine/effects/smoke/visibility.hpp"

namespace septet::smoke {

double extinction_per_m(const State& state, const Vec3& world_m) {
  const Grid& grid = state.grid;
  const Vec3 p = glm::floor(grid.grid_from_world(world_m));
  if (!(p.x >= 0.0 && p.y >= 0.0 && p.z >= 0.0 && p.x < grid.nx && p.y < grid.ny && p.z < grid.nz)) return 0.0;
  const int cell = grid.index(static_cast<int>(p.x), static_cast<int>(p.y), static_cast<int>(p.z));
  return state.extinction_area_m2[cell] / (grid.cell_m * grid.cell_m * grid.cell_m);
}

std::optional<double> visibility_m(double extinction_per_m, bool shines) {
  if (!(extinction_per_m > 0.0)) return std::nullopt;
  return (shines ? 8.0 : 3.0) / extinction_per_m;
}

}  // namespace septet::smoke
