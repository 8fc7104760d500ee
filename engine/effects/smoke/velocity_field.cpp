#include "engine/effects/smoke/velocity_field.hpp"

#include <algorithm>
#include <cmath>

#include "engine/effects/smoke/smoke_state.hpp"

namespace septet::smoke {
namespace {

constexpr int pad = 3;

struct Padded {
  int nx, ny, nz;
  explicit Padded(const Grid& grid)
      : nx(grid.nx + 2 * pad), ny(grid.ny + 2 * pad), nz(grid.nz + 2 * pad) {}
  std::size_t size() const { return static_cast<std::size_t>(nx) * ny * nz; }
  /// Of the grid's cell (0, j, k).
  std::ptrdiff_t row(int j, int k) const {
    return (static_cast<std::ptrdiff_t>(k + pad) * ny + (j + pad)) * nx + pad;
  }
};

/// What lies outside the grid never changes: written once, when the memory is made.
void fill_outside(const Grid& grid, const Padded& padded, std::vector<float>& attraction) {
  for (int k = -pad; k < grid.nz + pad; ++k)
    for (int j = -pad; j < grid.ny + pad; ++j)
      for (int i = -pad; i < grid.nx + pad; ++i)
        attraction[padded.row(j, k) + i] = is_open(grid, i, j, k) ? 1.0f : -1.0f;
}

void sum_along_rows(const Grid& grid, const Padded& padded, VelocityField& field) {
  for (int k = -1; k <= grid.nz; ++k)
    for (int j = -1; j <= grid.ny; ++j) {
      bool needed = false;
      for (int b = std::max(k - 1, 0); b <= std::min(k + 1, grid.nz - 1); ++b)
        for (int a = std::max(j - 1, 0); a <= std::min(j + 1, grid.ny - 1); ++a)
          needed = needed || field.row_used[b * grid.ny + a];
      if (!needed) continue;
      const std::ptrdiff_t row = padded.row(j, k);
      const float* __restrict f = field.attraction.data() + row;
      float* __restrict difference = field.difference.data() + row;
      float* __restrict sum = field.sum.data() + row;
      float* __restrict magnitude = field.magnitude.data() + row;
      for (int i = 0; i < grid.nx; ++i) {
        difference[i] = f[i + 1] - f[i - 1];
        sum[i] = f[i - 1] + f[i] + f[i + 1];
        magnitude[i] = std::abs(f[i - 1]) + std::abs(f[i]) + std::abs(f[i + 1]);
      }
    }
}

/// A part of a row, so short that it stays in the nearest cache until it is packed.
constexpr int span_cells = 64;
struct Span {
  alignas(32) float rest_x[span_cells], rest_y[span_cells], rest_z[span_cells];
  alignas(32) float above_x[span_cells], above_y[span_cells], above_z[span_cells];
};

/// The convolution along a span of a row of cells, in multiples of velocity_quantum.
void convolve(int count, const Padded& padded, const VelocityField& field, std::ptrdiff_t row,
              float speed, Span& __restrict out) {
  const std::ptrdiff_t y = padded.nx, z = y * padded.ny;
  const float* __restrict f = field.attraction.data() + row;
  const float* __restrict d = field.difference.data() + row;
  const float* __restrict s = field.sum.data() + row;
  const float* __restrict m = field.magnitude.data() + row;
  for (int i = 0; i < count; ++i) {
    // The 26 neighbours, a layer of three rows at a time.
    float above_x = d[i - y + z] + d[i + z] + d[i + y + z];
    float above_y = s[i + y + z] - s[i - y + z];
    float above_z = s[i - y + z] + s[i + z] + s[i + y + z];
    float rest_x = d[i - y] + d[i] + d[i + y] + d[i - y - z] + d[i - z] + d[i + y - z];
    float rest_y = s[i + y] - s[i - y] + s[i + y - z] - s[i - y - z];
    float rest_z = -(s[i - y - z] + s[i - z] + s[i + y - z]);
    float magnitude = m[i - y + z] + m[i + z] + m[i + y + z] + m[i - y] + m[i] + m[i + y] +
                      m[i - y - z] + m[i - z] + m[i + y - z] - std::abs(f[i]);
    // The quincunxes two cells away.
    const float* __restrict top = f + 2 * z;
    const float* __restrict low = f - 2 * z;
    const float a = top[i - 2 - 2 * y], b = top[i + 2 - 2 * y], c = top[i - 2 + 2 * y],
                e = top[i + 2 + 2 * y];
    above_x += 2.0f * (b + e - a - c);
    above_y += 2.0f * (c + e - a - b);
    above_z += 2.0f * (a + b + c + e + top[i]);
    const float g = low[i - 2 - 2 * y], h = low[i + 2 - 2 * y], p = low[i - 2 + 2 * y],
                q = low[i + 2 + 2 * y];
    rest_x += 2.0f * (h + q - g - p + f[i + 2] - f[i - 2]);
    rest_y += 2.0f * (p + q - g - h + f[i + 2 * y] - f[i - 2 * y]);
    rest_z -= 2.0f * (g + h + p + q + low[i]);
    magnitude += std::abs(a) + std::abs(b) + std::abs(c) + std::abs(e) + std::abs(g) +
                 std::abs(h) + std::abs(p) + std::abs(q) + std::abs(top[i]) + std::abs(low[i]) +
                 std::abs(f[i - 2]) + std::abs(f[i + 2]) + std::abs(f[i - 2 * y]) +
                 std::abs(f[i + 2 * y]);
    // The six samples three cells away.
    above_z += 3.0f * f[i + 3 * z];
    rest_x += 3.0f * (f[i + 3] - f[i - 3]);
    rest_y += 3.0f * (f[i + 3 * y] - f[i - 3 * y]);
    rest_z -= 3.0f * f[i - 3 * z];
    magnitude += std::abs(f[i - 3]) + std::abs(f[i + 3]) + std::abs(f[i - 3 * y]) +
                 std::abs(f[i + 3 * y]) + std::abs(f[i - 3 * z]) + std::abs(f[i + 3 * z]);
    const float scale = speed / (velocity_quantum * (magnitude + 1e-6f));
    out.rest_x[i] = rest_x * scale;
    out.rest_y[i] = rest_y * scale;
    out.rest_z[i] = rest_z * scale;
    out.above_x[i] = above_x * scale;
    out.above_y[i] = above_y * scale;
    out.above_z[i] = above_z * scale;
  }
}

/// To the nearest, without a branch: what is converted is positive.
std::int16_t packed(float value) {
  constexpr float most = greatest_velocity / velocity_quantum;
  const float above_least = value > -most ? value : -most;
  const float bounded = above_least < most ? above_least : most;
  return static_cast<std::int16_t>(static_cast<std::int32_t>(bounded + 32768.5f) - 32768);
}

void pack(int count, const Span& span, const float* __restrict attraction,
          CellVelocity* __restrict out) {
  for (int i = 0; i < count; ++i)
    out[i] = {{packed(span.rest_x[i]), packed(span.rest_y[i]), packed(span.rest_z[i])},
              packed((attraction[i] < 0.5f ? 0.5f - attraction[i] : 0.0f) / velocity_quantum),
              {packed(span.above_x[i]), packed(span.above_y[i]), packed(span.above_z[i])},
              0};
}

}  // namespace

void update_velocity_field(const State& state, std::span<const float> table,
                           VelocityField& field) {
  const Grid& grid = state.grid;
  const Padded padded(grid);
  if (field.attraction.size() != padded.size()) {
    for (auto* memory : {&field.attraction, &field.difference, &field.sum, &field.magnitude})
      memory->assign(padded.size(), 0.0f);
    field.cells.assign(static_cast<std::size_t>(grid.cells()), {});
    field.row_used.assign(static_cast<std::size_t>(grid.ny) * grid.nz, 0);
    fill_outside(grid, padded, field.attraction);
  }
  const auto last = static_cast<std::uint16_t>(table.size() - 1);
  for (int k = 0; k < grid.nz; ++k)
    for (int j = 0; j < grid.ny; ++j) {
      const int first = grid.index(0, j, k);
      float* __restrict f = field.attraction.data() + padded.row(j, k);
      const std::uint16_t* __restrict density = state.density.data() + first;
      const std::uint8_t* __restrict full = state.full.data() + first;
      std::uint16_t any = 0;
      for (int i = 0; i < grid.nx; ++i) {
        any |= density[i];
        f[i] = table[full[i] ? last : std::min(density[i], last)];
      }
      field.row_used[k * grid.ny + j] = any != 0;
    }
  sum_along_rows(grid, padded, field);
  const auto speed = static_cast<float>(state.parameters.speed_cells_per_s);
  Span span;
  for (int k = 0; k < grid.nz; ++k)
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx && field.row_used[k * grid.ny + j]; i += span_cells) {
        const int count = std::min(span_cells, grid.nx - i);
        const std::ptrdiff_t first = padded.row(j, k) + i;
        convolve(count, padded, field, first, speed, span);
        pack(count, span, field.attraction.data() + first,
             field.cells.data() + grid.index(i, j, k));
      }
}

}  // namespace septet::smoke
