#include "engine/effects/smoke/ceiling.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/effects/smoke/smoke_state.hpp"
#include "engine/math/gravity.hpp"

namespace septet::smoke {
namespace {

constexpr float g_mps2 = static_cast<float>(gravity_mps2);
/// ρ·c·T of air: for a gas of two atoms 3.5 times its pressure, whatever its temperature.
constexpr float warmth_per_m3_j = 3.5f * 101'325.0f;
/// Slices whose mean makes the layer smooth: as long as it is broad.
constexpr float smoothed_m = 6.0f;
/// Distance within which a fire's side decides the direction, beside that of other fires.
constexpr float reach_m = 50.0f;
/// Half the length over which the direction turns round above a fire.
constexpr float turn_m = 2.0f;

/// 1 towards the far end, −1 towards the near one, 0 in between: away from the fires, each with the warmth it gave.
float way_out(const State& state, float x_m) {
  float sum = 0.0f, weights = 0.0f;
  for (std::size_t e = 0; e < state.emitters.size(); ++e) {
    if (!(state.warmth.of_emitter_j[e] > 0.0f)) continue;
    const auto fire_m =
        static_cast<float>(state.grid.grid_from_world(state.emitters[e].position_m).x * state.grid.cell_m);
    const float away_m = x_m - fire_m, far = away_m / reach_m;
    const float weight = state.warmth.of_emitter_j[e] / (1.0f + far * far);
    sum += weight * std::clamp(away_m / turn_m, -1.0f, 1.0f);
    weights += weight;
  }
  return weights > 0.0f ? sum / weights : 0.0f;
}

/// Mean over the slices around each: running sums in double, so that nothing is left of what has gone.
std::vector<float> smoothed(const std::vector<float>& values, int reach) {
  std::vector<double> sums(values.size() + 1, 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) sums[i + 1] = sums[i] + values[i];
  std::vector<float> mean(values.size());
  const int count = static_cast<int>(values.size());
  for (int i = 0; i < count; ++i) {
    const int low = std::max(0, i - reach), high = std::min(count, i + reach + 1);
    mean[i] = static_cast<float>((sums[high] - sums[low]) / (2 * reach + 1));
  }
  return mean;
}

}  // namespace

std::vector<TubeSlice> tube_slices(const Grid& grid) {
  std::vector<TubeSlice> slices(static_cast<std::size_t>(grid.nx));
  for (int i = 0; i < grid.nx; ++i) {
    int low = grid.nz, high = -1, free = 0;
    for (int k = 0; k < grid.nz; ++k)
      for (int j = 0; j < grid.ny; ++j) {
        if (grid.wall[grid.index(i, j, k)]) continue;
        low = std::min(low, k), high = k;
        ++free;
      }
    if (high < low) continue;
    slices[i] = {static_cast<float>(low), static_cast<float>(high + 1), static_cast<float>(free) / (high + 1 - low)};
  }
  return slices;
}

void update_ceiling_current(const State& state, VelocityField& field) {
  const Grid& grid = state.grid;
  std::ranges::fill(field.current, 0.0f);
  const bool is_warm = std::ranges::any_of(state.warmth.of_emitter_j, [](float joules) { return joules > 0.0f; });
  if (!is_warm || (grid.open_faces & open_z_high) != 0) return;
  const auto cell_m = static_cast<float>(grid.cell_m);
  const int reach = static_cast<int>(0.5f * smoothed_m / cell_m);
  const std::vector<float> warmth_j = smoothed(state.warmth.slice_j, reach),
                           height = smoothed(state.warmth.slice_j_cells, reach);
  const auto froude = static_cast<float>(state.parameters.froude);
  for (int i = 0; i < grid.nx; ++i) {
    const TubeSlice& tube = field.slices[i];
    if (!(warmth_j[i] > 0.0f) || !(tube.width > 0.0f)) continue;
    const float high = tube.roof - tube.floor;
    const float layer = std::clamp(2.0f * (tube.roof - height[i] / warmth_j[i]), std::min(1.0f, 0.5f * high), high);
    const float head = g_mps2 * warmth_j[i] / (warmth_per_m3_j * tube.width * cell_m * cell_m);
    const float mps = froude * std::sqrt(head * (1.0f - layer / high));
    const float towards = way_out(state, (static_cast<float>(i) + 0.5f) * cell_m);
    const float out = mps * towards / (cell_m * velocity_quantum), back = -out * layer / std::max(high - layer, layer);
    for (int k = 0; k < grid.nz; ++k) {
      const float within = std::clamp(static_cast<float>(k + 1) - (tube.roof - layer), 0.0f, 1.0f);
      field.current[static_cast<std::size_t>(k) * grid.nx + i] = within * out + (1.0f - within) * back;
    }
  }
}

}  // namespace septet::smoke
