#include "engine/effects/ice/still_ice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "engine/core/random.hpp"

namespace septet::ice {

std::vector<Icicle> icicles_of(const IcicleRow& row, double thawed_kh) {
  constexpr double mean_gap_m = 0.22,
                   thickness = 0.045;  // Root's radius over length: slender, as drips make them.
  constexpr std::size_t most = 32;
  std::vector<Icicle> icicles;
  const double length_m = glm::length(row.to_m - row.from_m);
  if (!(length_m > 0.0)) return icicles;
  Random random(row.seed, 5);
  double at_m = mean_gap_m * random.uniform();
  while (at_m < length_m && icicles.size() < most) {
    // Water finds some places more often than others: few are long.
    const double share = random.uniform();
    Icicle icicle;
    icicle.root_m = row.from_m + (at_m / length_m) * (row.to_m - row.from_m);
    icicle.length_m = row.longest_m * (0.12 + 0.88 * share * share * share);
    icicle.radius_m = 0.008 + thickness * icicle.length_m;
    const double holds_until = random.uniform(0.25, 0.7);
    at_m += mean_gap_m * random.uniform(0.3, 1.7);
    const double radius_m = left_m(icicle.radius_m, thawed_kh);
    if (radius_m <= holds_until * icicle.radius_m) continue;
    icicle.length_m *= radius_m / icicle.radius_m;
    icicle.radius_m = radius_m;
    icicles.push_back(icicle);
  }
  return icicles;
}

void append_icicle(std::vector<IceVertex>& surface, const Icicle& icicle, const Vec3& origin_m) {
  constexpr int around = 7, rings = 6;
  constexpr double ripple = 0.10, turns = 2.5;
  std::array<std::array<IceVertex, around + 1>, rings + 1> grid;
  const Vec3 root = icicle.root_m - origin_m;
  const double slope = icicle.radius_m / std::max(icicle.length_m, 1e-6);
  for (std::size_t j = 0; j <= rings; ++j)
    for (std::size_t i = 0; i <= around; ++i) {
      const double down = static_cast<double>(j) / rings,
                   angle = 2.0 * std::numbers::pi * static_cast<double>(i % around) / around;
      const double wave = 1.0 + ripple * std::sin(2.0 * std::numbers::pi * turns * down + 3.0 * icicle.length_m);
      const double radius = icicle.radius_m * (1.0 - down) * wave;
      const Vec3 out(std::cos(angle), std::sin(angle), 0.0);
      IceVertex& vertex = grid[j][i];
      vertex.position_m = glm::vec3(root + radius * out - Vec3(0.0, 0.0, down * icicle.length_m));
      vertex.normal = glm::vec3(glm::normalize(out - Vec3(0.0, 0.0, slope)));
      vertex.rest_m = vertex.position_m;
    }
  for (std::size_t j = 0; j < rings; ++j)
    for (std::size_t i = 0; i < around; ++i) {
      const IceVertex &a = grid[j][i], &b = grid[j][i + 1], &c = grid[j + 1][i + 1], &d = grid[j + 1][i];
      for (const IceVertex* vertex : {&a, &d, &b}) surface.push_back(*vertex);
      if (j + 1 < rings)
        for (const IceVertex* vertex : {&b, &d, &c}) surface.push_back(*vertex);
    }
  IceVertex middle = grid[0][0];
  middle.position_m = middle.rest_m = glm::vec3(root);
  for (std::size_t i = 0; i < around; ++i) {
    IceVertex a = grid[0][i], b = grid[0][i + 1];
    for (IceVertex* vertex : {&middle, &a, &b}) {
      vertex->normal = {0.0f, 0.0f, 1.0f};
      surface.push_back(*vertex);
    }
  }
}

std::vector<IceVertex> box_surface(const Vec3& low_m, const Vec3& high_m, int cells_x, int cells_y) {
  std::vector<IceVertex> surface;
  const auto at = [&](double x, double y, double z) { return glm::vec3(low_m + Vec3(x, y, z) * (high_m - low_m)); };
  const auto quad = [&](const std::array<glm::vec3, 4>& corners, const glm::vec3& normal) {
    for (const std::size_t i : {0u, 1u, 2u, 0u, 2u, 3u}) surface.push_back({corners[i], normal, corners[i]});
  };
  const auto step = [](int i, int cells) { return static_cast<double>(i) / cells; };
  for (int i = 0; i < cells_x; ++i) {
    const double x0 = step(i, cells_x), x1 = step(i + 1, cells_x);
    for (int j = 0; j < cells_y; ++j) {
      const double y0 = step(j, cells_y), y1 = step(j + 1, cells_y);
      quad({at(x0, y0, 1), at(x1, y0, 1), at(x1, y1, 1), at(x0, y1, 1)}, {0, 0, 1});
      quad({at(x0, y0, 0), at(x0, y1, 0), at(x1, y1, 0), at(x1, y0, 0)}, {0, 0, -1});
    }
    quad({at(x0, 0, 0), at(x1, 0, 0), at(x1, 0, 1), at(x0, 0, 1)}, {0, -1, 0});
    quad({at(x1, 1, 0), at(x0, 1, 0), at(x0, 1, 1), at(x1, 1, 1)}, {0, 1, 0});
  }
  for (int j = 0; j < cells_y; ++j) {
    const double y0 = step(j, cells_y), y1 = step(j + 1, cells_y);
    quad({at(0, y1, 0), at(0, y0, 0), at(0, y0, 1), at(0, y1, 1)}, {-1, 0, 0});
    quad({at(1, y0, 0), at(1, y1, 0), at(1, y1, 1), at(1, y0, 1)}, {1, 0, 0});
  }
  return surface;
}

}  // namespace septet::ice
