#include "engine/sight/walls.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/common.hpp>

#include "engine/math/plane_cells.hpp"
#include "engine/math/plane_vector.hpp"

namespace septet::sight {
namespace {

constexpr PlaneCells wall_cells{32.0};

/// True where the line between two places passes through the wall.
bool crosses(const Wall& wall, const Vec3& eye_m, const Vec3& place_m) {
  const Vec2 way = Vec2(place_m) - Vec2(eye_m), along = wall.to_m - wall.from_m, to_wall = wall.from_m - Vec2(eye_m);
  const double across = cross(way, along);
  if (across == 0.0) return false;  // Seen from its edge a thin wall hides nothing.
  const double on_way = cross(to_wall, along) / across, on_wall = cross(to_wall, way) / across;
  if (!(on_way > 0.0 && on_way < 1.0 && on_wall >= 0.0 && on_wall <= 1.0)) return false;
  const double height_m = eye_m.z + on_way * (place_m.z - eye_m.z);
  return height_m >= wall.low_m && height_m <= wall.high_m;
}

/// Steps of a line through cells along one axis (Amanatides and Woo 1987): in shares of its length.
struct Steps {
  std::int64_t cell = 0, last = 0, by = 0;
  double next = std::numeric_limits<double>::infinity(), each = std::numeric_limits<double>::infinity();

  Steps(double from_m, double to_m) : cell(wall_cells.index_of(from_m)), last(wall_cells.index_of(to_m)) {
    if (cell == last) return;
    by = to_m > from_m ? 1 : -1;
    const double edge_m = wall_cells.cell_m * static_cast<double>(by > 0 ? cell + 1 : cell);
    next = (edge_m - from_m) / (to_m - from_m);
    each = wall_cells.cell_m / std::abs(to_m - from_m);
  }
};

}  // namespace

Walls::Walls(std::vector<Wall> walls) : walls_(std::move(walls)) {
  for (std::uint32_t n = 0; n < walls_.size(); ++n)
    wall_cells.for_each(glm::min(walls_[n].from_m, walls_[n].to_m), glm::max(walls_[n].from_m, walls_[n].to_m),
                        [&](std::uint64_t key) { cells_[key].push_back(n); });
}

bool Walls::hide(const Vec3& eye_m, const Vec3& place_m, std::span<const std::uint32_t> gone) const {
  if (walls_.empty()) return false;
  Steps x(eye_m.x, place_m.x), y(eye_m.y, place_m.y);
  for (;;) {
    if (const auto cell = cells_.find(PlaneCells::key_of(x.cell, y.cell)); cell != cells_.end())
      for (const std::uint32_t n : cell->second)
        if (crosses(walls_[n], eye_m, place_m) && !std::ranges::binary_search(gone, walls_[n].thing)) return true;
    const bool x_is_over = x.cell == x.last, y_is_over = y.cell == y.last;
    if (x_is_over && y_is_over) return false;
    Steps& axis = y_is_over || (!x_is_over && x.next < y.next) ? x : y;
    axis.cell += axis.by;
    axis.next += axis.each;
  }
}

}  // namespace septet::sight
