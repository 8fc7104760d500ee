#pragma once
/// The paper's update with its bias texture [lifetime][sample] (figures 7 and 8) and its two ways of cooling, for
/// comparison with `advance_smoke`, whose bias is a formula of the age.
///
/// A row of the texture holds a factor for each of the 46 samples; a particle reads the row of its lifetime. It goes to
/// the next row with its age, or "when the particle has been in a low density (fewer warm particles) environment for a
/// number of time steps". The paper gives neither the texture's numbers nor the density: here the bias falls evenly
/// from row to row, and a density is low below the crowd, at which a cell attracts nothing.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/effects/smoke/attraction.hpp"
#include "engine/effects/smoke/move_particles.hpp"

namespace septet::smoke {

using BiasTexture = std::vector<std::array<float, 46>>;

/// The samples above weigh 1 + heat in the first row and 1 in the last.
inline BiasTexture bias_texture(std::size_t rows, double heat) {
  BiasTexture texture(rows);
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t n = 0; n < texture[row].size(); ++n) {
      const double left = 1.0 - static_cast<double>(row) / static_cast<double>(rows - 1);
      texture[row][n] = static_cast<float>(sample_pattern()[n].z > 0 ? 1.0 + heat * left : 1.0);
    }
  return texture;
}

enum class Cooling : std::uint8_t { by_age, in_thin_smoke };

/// Ticks that each particle has cooled for, by its number.
struct CooledTicks {
  std::vector<int> ticks;
};

/// The pseudo-code's velocity, in cells: one look at grid, sigmoid and bias for each of the 46 samples.
inline Vec3 biased_sample(const State& state, std::span<const float> sigmoid, int cell,
                          const std::array<float, 46>& bias) {
  const int nx = state.grid.nx, ny = state.grid.ny;
  const int i = cell % nx, j = cell / nx % ny, k = cell / (nx * ny);
  Vec3 sum(0.0);
  double count = 0.0;
  for (std::size_t n = 0; n < bias.size(); ++n) {
    const SampleOffset& s = sample_pattern()[n];
    double f = -1.0;
    if (state.grid.inside(i + s.x, j + s.y, k + s.z))
      f = sigmoid[std::min<std::size_t>(
          state.density[static_cast<std::size_t>(state.grid.index(i + s.x, j + s.y, k + s.z))], sigmoid.size() - 1)];
    count += std::abs(f);
    sum += Vec3(s.x, s.y, s.z) * (f * double(bias[n]));
  }
  return count > 0.0 ? sum / count : Vec3(0.0);
}

/// One tick of a closed box without walls. A row lasts `ticks_a_row`; the last one for good.
inline void advance_with_texture(State& state, const BiasTexture& texture, Cooling cooling, int ticks_a_row,
                                 CooledTicks& cooled, double step_s) {
  emit(state, step_s);
  const std::vector<float> sigmoid = attraction_table(state.parameters);
  State before;
  before.grid = state.grid;
  before.density = state.density;
  cooled.ticks.resize(state.particles.numbers, 0);
  const double scale = state.parameters.speed_cells_per_s * step_s;
  move_particles(state, step_s, [&](Block& block) {
    for (std::size_t n = 0; n < static_cast<std::size_t>(block.count); ++n) {
      int& ticks = cooled.ticks[state.particles.number[block.first + n]];
      const auto row = std::min(static_cast<std::size_t>(ticks / ticks_a_row), texture.size() - 1);
      const Vec3 d = scale * biased_sample(before, sigmoid, block.cell[n], texture[row]);
      for (int axis = 0; axis < 3; ++axis)
        block.step[4 * n + static_cast<std::size_t>(axis)] = static_cast<float>(d[axis]);
      const bool thin = before.density[static_cast<std::size_t>(block.cell[n])] < state.parameters.crowd;
      ticks += cooling == Cooling::by_age || thin ? 1 : 0;
    }
  });
}

}  // namespace septet::smoke
