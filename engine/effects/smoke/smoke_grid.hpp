#pragma once
/// The box of cells in which smoke moves: its place, its wall cells, its open faces.
///
/// Grid coordinates are cells: x, y, z from the lower corner, z up; cell (i, j, k) holds [i, i+1) × [j, j+1) × [k,
/// k+1). Cells outside the box count as wall, but a particle that crosses an open face has left and is no longer
/// followed.

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "engine/math/rigid_transform.hpp"

namespace septet::smoke {

/// Limits of a scenario's grid: number of cells along an axis, and in all.
inline constexpr int max_cells_along = 4096, max_cells = 1 << 23;

enum OpenFace : std::uint8_t {
  open_x_low = 1,
  open_x_high = 2,
  open_y_low = 4,
  open_y_high = 8,
  open_z_low = 16,
  open_z_high = 32
};

struct Grid {
  RigidTransform world_from_grid;  ///< Origin at the lower corner; metres on both sides.
  double cell_m = 0.5;             ///< Edge of a cell; about the size of a drawn puff.
  int nx = 0, ny = 0, nz = 0;
  std::uint8_t open_faces = 0;     ///< OpenFace bits.
  std::vector<std::uint8_t> wall;  ///< 1 where a cell is full for good; x runs fastest.

  int cells() const { return nx * ny * nz; }
  int index(int i, int j, int k) const { return (k * ny + j) * nx + i; }
  bool inside(int i, int j, int k) const { return i >= 0 && j >= 0 && k >= 0 && i < nx && j < ny && k < nz; }
  Vec3 grid_from_world(const Vec3& world_m) const { return inverse(world_from_grid) * world_m / cell_m; }
  Vec3 world_from_cells(const Vec3& grid) const { return world_from_grid * (grid * cell_m); }
};

/// True where a cell outside the box lies in open air: every face that it is beyond is open.
inline bool is_open(const Grid& grid, int i, int j, int k) {
  const auto beyond = [&](int at, int count, std::uint8_t low, std::uint8_t high) {
    return at < 0 ? (grid.open_faces & low) != 0 : at < count || (grid.open_faces & high) != 0;
  };
  return !grid.inside(i, j, k) && beyond(i, grid.nx, open_x_low, open_x_high) &&
         beyond(j, grid.ny, open_y_low, open_y_high) && beyond(k, grid.nz, open_z_low, open_z_high);
}

/// Height (k) of the free cell whose image in the ceiling, or else in the floor, a wall cell is: k itself where the cell
/// is free, where neither is within three cells of it, or where the image would be in a wall.
int mirrored_height(const Grid& grid, int i, int j, int k);

/// A box without walls. Sizes must be 1 to `max_cells_along` and `max_cells` in all (checked).
Grid make_grid(const RigidTransform& world_from_grid, double cell_m, int nx, int ny, int nz, std::uint8_t open_faces);

/// Makes a wall of every cell for whose centre `is_wall` is true (world frame).
void add_walls(Grid& grid, const std::function<bool(const Vec3& world_m)>& is_wall);

}  // namespace septet::smoke
