#include "engine/effects/smoke/attraction.hpp"

#include <algorithm>
#include <cmath>

namespace septet::smoke {

const std::array<SampleOffset, 46>& sample_pattern() {
  static const auto pattern = [] {
    std::array<SampleOffset, 46> offsets{};
    std::size_t n = 0;
    for (int z = -1; z <= 1; ++z)
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
          if (x != 0 || y != 0 || z != 0) offsets[n++] = {x, y, z};
    for (int z = -2; z <= 2; z += 4)
      for (int y = -2; y <= 2; y += 4)
        for (int x = -2; x <= 2; x += 4) offsets[n++] = {x, y, z};
    for (const int r : {-3, -2, 2, 3}) {
      offsets[n++] = {r, 0, 0};
      offsets[n++] = {0, r, 0};
      offsets[n++] = {0, 0, r};
    }
    return offsets;
  }();
  return pattern;
}

double attraction(double density, const Parameters& parameters) {
  if (density >= 2.0 * parameters.crowd) return -1.0;
  const auto logistic = [&](double rho) {
    return 1.0 - 2.0 / (1.0 + std::exp(-parameters.steepness * (rho - parameters.crowd)));
  };
  return logistic(density) / logistic(0.0);
}

std::vector<float> attraction_table(const Parameters& parameters) {
  std::vector<float> table;
  const int full = std::max(1, static_cast<int>(std::ceil(2.0 * parameters.crowd)));
  table.reserve(static_cast<std::size_t>(full) + 1);
  for (int density = 0; density < full; ++density) table.push_back(static_cast<float>(attraction(density, parameters)));
  table.push_back(-1.0f);
  return table;
}

Vec3 mean_sample(const State& state, std::span<const float> table, int i, int j, int k, double bias) {
  const Grid& grid = state.grid;
  Vec3 sum(0.0);
  double magnitude = 0.0;
  for (const SampleOffset& s : sample_pattern()) {
    const int x = i + s.x, y = j + s.y, z = k + s.z;
    double f = -1.0;
    const int mirrored = state.parameters.roof_mirrors ? mirrored_height(grid, x, y, z) : z;
    if (grid.inside(x, y, mirrored)) {
      const int cell = grid.index(x, y, mirrored);
      if (!state.full[cell]) f = table[std::min<std::size_t>(state.density[cell], table.size() - 1)];
    } else if (is_open(grid, x, y, z)) {
      f = 1.0;
    }
    magnitude += std::abs(f);
    sum += Vec3(s.x, s.y, s.z) * (f * (s.z > 0 ? bias : 1.0));
  }
  return magnitude > 0.0 ? sum / magnitude : Vec3(0.0);
}

}  // namespace septet::smoke
