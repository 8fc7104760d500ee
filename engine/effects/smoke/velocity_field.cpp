#include "engine/effects/smoke/velocity_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/effects/smoke/ceiling.hpp"
#include "engine/effects/smoke/smoke_state.hpp"

namespace septet::smoke {
namespace {

constexpr int pad = 3;

struct Padded {
  int nx, ny, nz;
  explicit Padded(const Grid& grid) : nx(grid.nx + 2 * pad), ny(grid.ny + 2 * pad), nz(grid.nz + 2 * pad) {}
  std::size_t size() const { return static_cast<std::size_t>(nx) * ny * nz; }
  /// Index of the grid's cell (0, j, k).
  std::ptrdiff_t row(int j, int k) const { return static_cast<std::ptrdiff_t>(k + pad) * ny * nx + in_layer(j); }
  std::ptrdiff_t in_layer(int j) const { return static_cast<std::ptrdiff_t>(j + pad) * nx + pad; }
};

std::vector<MirroredRun> mirrored_runs(const Grid& grid, const Padded& padded) {
  std::vector<MirroredRun> runs;
  for (int k = -pad; k < grid.nz + pad; ++k)
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i) {
        const int image = mirrored_height(grid, i, j, k);
        if (image == k) continue;
        const std::ptrdiff_t to = padded.row(j, k) + i, from = padded.row(j, image) + i;
        const bool goes_on =
            !runs.empty() && runs.back().to + runs.back().count == to && runs.back().from + runs.back().count == from;
        if (goes_on)
          ++runs.back().count;
        else
          runs.push_back({from, to, 1});
      }
  return runs;
}

/// Values outside the grid never change: written once, when the memory is made.
void fill_outside(const Grid& grid, const Padded& padded, std::vector<float>& attraction) {
  for (int k = -pad; k < grid.nz + pad; ++k)
    for (int j = -pad; j < grid.ny + pad; ++j)
      for (int i = -pad; i < grid.nx + pad; ++i)
        attraction[padded.row(j, k) + i] = is_open(grid, i, j, k) ? 1.0f : -1.0f;
}

/// Adds sums over 3 cells of a row (differences, sums, magnitudes) and those of the rows beside it, `y` numbers apart,
/// to sums over 3 × 3.
void add_rows(int count, std::ptrdiff_t y, const float* __restrict d, const float* __restrict s,
              const float* __restrict m, float* __restrict along_x, float* __restrict along_y, float* __restrict sum,
              float* __restrict magnitude) {
  for (int i = 0; i < count; ++i) {
    along_x[i] = d[i - y] + d[i] + d[i + y];
    along_y[i] = s[i + y] - s[i - y];
    sum[i] = s[i - y] + s[i] + s[i + y];
    magnitude[i] = m[i - y] + m[i] + m[i + y];
  }
}

/// The sums of layer k, for the rows whose neighbours need them.
void sum_layer(const Grid& grid, const Padded& padded, int k, VelocityField& field) {
  const auto used_around = [&](int row, int reach) {
    for (int b = std::max(k - 1, 0); b <= std::min(k + 1, grid.nz - 1); ++b)
      for (int a = std::max(row - reach, 0); a <= std::min(row + reach, grid.ny - 1); ++a)
        if (field.row_used[static_cast<std::size_t>(b * grid.ny + a)]) return true;
    return false;
  };
  for (int j = -1; j <= grid.ny; ++j) {
    if (!used_around(j, 1)) continue;
    const float* __restrict f = field.attraction.data() + padded.row(j, k);
    float* __restrict difference = field.rows.along_x.data() + padded.in_layer(j);
    float* __restrict sum = field.rows.sum.data() + padded.in_layer(j);
    float* __restrict magnitude = field.rows.magnitude.data() + padded.in_layer(j);
    for (int i = 0; i < grid.nx; ++i) {
      difference[i] = f[i + 1] - f[i - 1];
      sum[i] = f[i - 1] + f[i] + f[i + 1];
      magnitude[i] = std::abs(f[i - 1]) + std::abs(f[i]) + std::abs(f[i + 1]);
    }
  }
  LayerSums& layer = field.layers[static_cast<std::size_t>((k + 3) % 3)];
  for (int j = 0; j < grid.ny; ++j) {
    if (!used_around(j, 0)) continue;
    const std::ptrdiff_t row = padded.in_layer(j);
    add_rows(grid.nx, padded.nx, field.rows.along_x.data() + row, field.rows.sum.data() + row,
             field.rows.magnitude.data() + row, layer.along_x.data() + row, layer.along_y.data() + row,
             layer.sum.data() + row, layer.magnitude.data() + row);
  }
}

/// A part of a row, so short that it stays in the nearest cache until it is packed.
constexpr int span_cells = 64;
struct Span {
  alignas(32) float rest_x[span_cells], rest_y[span_cells], rest_z[span_cells];
  alignas(32) float above_x[span_cells], above_y[span_cells], above_z[span_cells];
};

/// Sums of the layers above, of and below a row of cells, from its first cell on.
struct Around {
  const LayerSums &above, &level, &below;
  std::ptrdiff_t first;
};

/// The convolution along a span of a row of cells, in multiples of velocity_quantum.
void convolve(int count, const Padded& padded, const float* attraction, const Around& around, float speed,
              const float* __restrict current, Span& __restrict out) {
  const std::ptrdiff_t y = padded.nx, z = y * padded.ny;
  const float* __restrict f = attraction;
  const auto of = [&](const std::vector<float>& sums) { return sums.data() + around.first; };
  const float* __restrict x1 = of(around.above.along_x);
  const float* __restrict y1 = of(around.above.along_y);
  const float* __restrict s1 = of(around.above.sum);
  const float* __restrict m1 = of(around.above.magnitude);
  const float* __restrict x0 = of(around.level.along_x);
  const float* __restrict y0 = of(around.level.along_y);
  const float* __restrict m0 = of(around.level.magnitude);
  const float* __restrict x_ = of(around.below.along_x);
  const float* __restrict y_ = of(around.below.along_y);
  const float* __restrict s_ = of(around.below.sum);
  const float* __restrict m_ = of(around.below.magnitude);
  for (int i = 0; i < count; ++i) {
    // The 26 neighbours.
    float above_x = x1[i], above_y = y1[i], above_z = s1[i];
    float rest_x = x0[i] + x_[i], rest_y = y0[i] + y_[i], rest_z = -s_[i];
    float magnitude = m1[i] + m0[i] + m_[i] - std::abs(f[i]);
    // The quincunxes two cells away.
    const float* __restrict top = f + 2 * z;
    const float* __restrict low = f - 2 * z;
    const float a = top[i - 2 - 2 * y], b = top[i + 2 - 2 * y], c = top[i - 2 + 2 * y], e = top[i + 2 + 2 * y];
    above_x += 2.0f * (b + e - a - c);
    above_y += 2.0f * (c + e - a - b);
    above_z += 2.0f * (a + b + c + e + top[i]);
    const float g = low[i - 2 - 2 * y], h = low[i + 2 - 2 * y], p = low[i - 2 + 2 * y], q = low[i + 2 + 2 * y];
    rest_x += 2.0f * (h + q - g - p + f[i + 2] - f[i - 2]);
    rest_y += 2.0f * (p + q - g - h + f[i + 2 * y] - f[i - 2 * y]);
    rest_z -= 2.0f * (g + h + p + q + low[i]);
    magnitude += std::abs(a) + std::abs(b) + std::abs(c) + std::abs(e) + std::abs(g) + std::abs(h) + std::abs(p) +
                 std::abs(q) + std::abs(top[i]) + std::abs(low[i]) + std::abs(f[i - 2]) + std::abs(f[i + 2]) +
                 std::abs(f[i - 2 * y]) + std::abs(f[i + 2 * y]);
    // The six samples three cells away.
    above_z += 3.0f * f[i + 3 * z];
    rest_x += 3.0f * (f[i + 3] - f[i - 3]);
    rest_y += 3.0f * (f[i + 3 * y] - f[i - 3 * y]);
    rest_z -= 3.0f * f[i - 3 * z];
    magnitude += std::abs(f[i - 3]) + std::abs(f[i + 3]) + std::abs(f[i - 3 * y]) + std::abs(f[i + 3 * y]) +
                 std::abs(f[i - 3 * z]) + std::abs(f[i + 3 * z]);
    const float scale = speed / (velocity_quantum * (magnitude + 1e-6f));
    out.rest_x[i] = rest_x * scale + current[i];
    out.rest_y[i] = rest_y * scale;
    out.rest_z[i] = rest_z * scale;
    out.above_x[i] = above_x * scale;
    out.above_y[i] = above_y * scale;
    out.above_z[i] = above_z * scale;
  }
}

/// Rounds two numbers to the nearest, branch-free (the converted values are positive), the first in the lower half.
std::uint32_t packed(float first, float second) {
  constexpr float most = greatest_velocity / velocity_quantum;
  const auto half = [](float value) {
    const float above_least = value > -most ? value : -most;
    const float bounded = above_least < most ? above_least : most;
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(bounded + 32768.5f) - 32768);
  };
  return (half(first) & 0xffffu) | (half(second) << 16);
}

/// Whole words, because interleaving vectors of halves is done one by one.
void pack(int count, const Span& __restrict span, const float* __restrict attraction, CellVelocity* out) {
  alignas(32) std::uint32_t words[4 * span_cells];
  for (int i = 0; i < count; ++i) {
    const float crowding = (attraction[i] < 0.5f ? 0.5f - attraction[i] : 0.0f) / velocity_quantum;
    words[4 * i] = packed(span.rest_x[i], span.rest_y[i]);
    words[4 * i + 1] = packed(span.rest_z[i], crowding);
    words[4 * i + 2] = packed(span.above_x[i], span.above_y[i]);
    words[4 * i + 3] = packed(span.above_z[i], 0.0f);
  }
  for (int i = 0; i < count; ++i) std::memcpy(out + i, words + 4 * i, sizeof(CellVelocity));
}

void look_up_row(int count, const std::uint16_t* __restrict density, const std::uint8_t* __restrict full,
                 const float* __restrict table, int last, float* __restrict attraction) {
  for (int i = 0; i < count; ++i) {
    const int counted = density[i] < last ? density[i] : last;
    attraction[i] = table[full[i] ? last : counted];
  }
}

/// Looks up the attraction of every cell, and marks the rows that have particles.
void look_up(const State& state, std::span<const float> table, const Padded& padded, VelocityField& field) {
  const Grid& grid = state.grid;
  for (int k = 0; k < grid.nz; ++k)
    for (int j = 0; j < grid.ny; ++j) {
      const int first = grid.index(0, j, k);
      const std::uint16_t* const density = state.density.data() + first;
      std::uint16_t any = 0;
      for (int i = 0; i < grid.nx; ++i) any |= density[i];
      look_up_row(grid.nx, density, state.full.data() + first, table.data(), static_cast<int>(table.size()) - 1,
                  field.attraction.data() + padded.row(j, k));
      field.row_used[static_cast<std::size_t>(k * grid.ny + j)] = any != 0;
    }
}

}  // namespace

void update_velocity_field(const State& state, std::span<const float> table, VelocityField& field) {
  const Grid& grid = state.grid;
  const Padded padded(grid);
  if (field.attraction.size() != padded.size()) {
    field.attraction.assign(padded.size(), 0.0f);
    const std::size_t layer = padded.size() / static_cast<std::size_t>(padded.nz);
    for (LayerSums* sums : {&field.rows, &field.layers[0], &field.layers[1], &field.layers[2]})
      for (auto* memory : {&sums->along_x, &sums->along_y, &sums->sum, &sums->magnitude}) memory->assign(layer, 0.0f);
    field.cells.assign(static_cast<std::size_t>(grid.cells()), {});
    field.row_used.assign(static_cast<std::size_t>(grid.ny) * grid.nz, 0);
    fill_outside(grid, padded, field.attraction);
    field.mirrored = state.parameters.roof_mirrors ? mirrored_runs(grid, padded) : std::vector<MirroredRun>{};
    field.slices = tube_slices(grid);
    field.current.assign(static_cast<std::size_t>(grid.nx) * grid.nz, 0.0f);
  }
  look_up(state, table, padded, field);
  for (const MirroredRun& run : field.mirrored)
    std::copy_n(field.attraction.data() + run.from, run.count, field.attraction.data() + run.to);
  update_ceiling_current(state, field);
  const auto speed = static_cast<float>(state.parameters.speed_cells_per_s);
  Span span;
  sum_layer(grid, padded, -1, field);
  sum_layer(grid, padded, 0, field);
  for (int k = 0; k < grid.nz; ++k) {
    sum_layer(grid, padded, k + 1, field);
    const auto layer = [&](int of) -> const LayerSums& { return field.layers[static_cast<std::size_t>((of + 3) % 3)]; };
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx && field.row_used[static_cast<std::size_t>(k * grid.ny + j)]; i += span_cells) {
        const int count = std::min(span_cells, grid.nx - i);
        const float* const attraction = field.attraction.data() + padded.row(j, k) + i;
        convolve(count, padded, attraction, {layer(k + 1), layer(k), layer(k - 1), padded.in_layer(j) + i}, speed,
                 field.current.data() + static_cast<std::ptrdiff_t>(k) * grid.nx + i, span);
        pack(count, span, attraction, field.cells.data() + grid.index(i, j, k));
      }
  }
}

}  // namespace septet::smoke
