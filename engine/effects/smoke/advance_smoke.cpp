#include <algorithm>
#include <cmath>

#include "engine/core/check.hpp"
#include "engine/effects/smoke/attraction.hpp"
#include "engine/effects/smoke/move_particles.hpp"

namespace septet::smoke {
namespace {

constexpr std::uint64_t sorting_ticks = 32;

struct Displacement {
  float dx, dy, dz;
};

/// Every cell whose centre a box covers is full, and those that it touches on by a quarter of a cell.
void mark_full(State& state, std::span<const Obstacle> obstacles) {
  const Grid& grid = state.grid;
  std::copy(grid.wall.begin(), grid.wall.end(), state.full.begin());
  const double margin_m = 0.25 * grid.cell_m;
  for (const Obstacle& box : obstacles) {
    const RigidTransform grid_from_box = inverse(grid.world_from_grid) * box.world_from_box;
    const RigidTransform box_from_grid = inverse(grid_from_box);
    const Vec3 half = box.half_size_m + margin_m;
    const double radius = glm::length(half);
    int low[3], high[3];
    const int count[3] = {grid.nx, grid.ny, grid.nz};
    bool outside = false;
    for (int axis = 0; axis < 3; ++axis) {
      const double centre = grid_from_box.position_m[axis];
      const double first = std::floor((centre - radius) / grid.cell_m),
                   last = std::floor((centre + radius) / grid.cell_m);
      outside = outside || !(last >= 0.0 && first < count[axis]);
      if (outside) break;
      low[axis] = static_cast<int>(std::max(first, 0.0));
      high[axis] = static_cast<int>(std::min(last, count[axis] - 1.0));
    }
    if (outside) continue;
    for (int k = low[2]; k <= high[2]; ++k)
      for (int j = low[1]; j <= high[1]; ++j)
        for (int i = low[0]; i <= high[0]; ++i) {
          const Vec3 p = box_from_grid * (Vec3(i + 0.5, j + 0.5, k + 0.5) * grid.cell_m);
          if (std::abs(p.x) <= half.x && std::abs(p.y) <= half.y && std::abs(p.z) <= half.z)
            state.full[grid.index(i, j, k)] = 1;
        }
  }
}

void count_extinction(State& state) {
  const Particles& particles = state.particles;
  struct Look {
    float area_m2, per_lifetime;
  };
  std::vector<Look> looks;
  for (const Emitter& e : state.emitters)
    looks.push_back({static_cast<float>(e.extinction_area_m2),
                     e.lifetime_s > 0.0 ? static_cast<float>(1.0 / e.lifetime_s) : 0.0f});
  std::fill(state.extinction_area_m2.begin(), state.extinction_area_m2.end(), 0.0f);
  for (std::size_t n = 0; n < particles.size(); ++n) {
    const Look& look = looks[particles.emitter[n]];
    const int cell = state.grid.index(static_cast<int>(particles.x[n]),
                                      static_cast<int>(particles.y[n]),
                                      static_cast<int>(particles.z[n]));
    state.extinction_area_m2[cell] +=
        look.area_m2 *
        static_cast<float>(remaining_extinction(particles.age_s[n] * look.per_lifetime));
  }
}

/// Particles that smoke brings to a cell: a particle is a ball with the deviation of one cell, as it is drawn. (Few come into
/// the cell itself, because walls repel.)
float density_around(const State& state, std::uint32_t cell) {
  constexpr std::array<float, 5> weight{0.054f, 0.242f, 0.399f, 0.242f, 0.054f};
  const Grid& grid = state.grid;
  const int at = static_cast<int>(cell), i = at % grid.nx, j = at / grid.nx % grid.ny, k = at / (grid.nx * grid.ny);
  float sum = 0.0f;
  for (int dk = std::max(-2, -k); dk <= std::min(2, grid.nz - 1 - k); ++dk)
    for (int dj = std::max(-2, -j); dj <= std::min(2, grid.ny - 1 - j); ++dj)
      for (int di = std::max(-2, -i); di <= std::min(2, grid.nx - 1 - i); ++di)
        if (const std::uint16_t density = state.density[grid.index(i + di, j + dj, k + dk)])
          sum += weight[di + 2] * weight[dj + 2] * weight[dk + 2] * static_cast<float>(density);
  return sum;
}

/// A 32nd of the walls a tick, for 32 ticks' time.
void leave_soot(State& state, double step_s) {
  constexpr std::size_t slices = 32;
  const std::size_t slice = state.tick % slices, count = state.beside_wall.size();
  const auto rate = static_cast<float>(state.parameters.soot_per_s * slices * step_s / state.parameters.crowd);
  for (std::size_t n = count * slice / slices; n < count * (slice + 1) / slices; ++n)
    state.soot[n] = std::min(1.0f, state.soot[n] + rate * density_around(state, state.beside_wall[n]));
}

std::vector<std::uint32_t> cells_beside_walls(const Grid& grid) {
  std::vector<std::uint32_t> cells;
  const auto is_wall = [&](int i, int j, int k) {
    return grid.inside(i, j, k) ? grid.wall[grid.index(i, j, k)] != 0 : !is_open(grid, i, j, k);
  };
  for (int k = 0; k < grid.nz; ++k)
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i)
        if (!is_wall(i, j, k) &&
            (is_wall(i - 1, j, k) || is_wall(i + 1, j, k) || is_wall(i, j - 1, k) ||
             is_wall(i, j + 1, k) || is_wall(i, j, k - 1) || is_wall(i, j, k + 1)))
          cells.push_back(static_cast<std::uint32_t>(grid.index(i, j, k)));
  return cells;
}

}  // namespace

State make_smoke(const Grid& grid, std::vector<Emitter> emitters, std::uint64_t seed,
                 std::size_t capacity, const Parameters& parameters) {
  SEPTET_CHECK(emitters.size() <= max_emitters, "{} emitters", emitters.size());
  SEPTET_CHECK(parameters.crowd > 0.0 && parameters.steepness > 0.0, "crowd {}, steepness {}",
               parameters.crowd, parameters.steepness);
  State state;
  state.grid = grid;
  state.parameters = parameters;
  state.emitters = std::move(emitters);
  state.seed = seed;
  state.capacity = std::min(capacity, max_particles);
  const auto cells = static_cast<std::size_t>(grid.cells());
  state.density.assign(cells, 0);
  state.extinction_area_m2.assign(cells, 0.0f);
  state.full = grid.wall;
  state.beside_wall = cells_beside_walls(grid);
  state.soot.assign(state.beside_wall.size(), 0.0f);
  return state;
}

StepReport advance_smoke(State& state, const Vec3& wind_mps, std::span<const Obstacle> obstacles,
                         double step_s) {
  SEPTET_CHECK(step_s > 0.0 && step_s <= 0.1, "step of {} s", step_s);
  mark_full(state, obstacles);
  const int born = emit(state, step_s);
  if (state.tick % sorting_ticks == 0) sort_by_cell(state);
  const std::vector<float> table = attraction_table(state.parameters);
  update_velocity_field(state, table, state.field);
  const glm::vec3 drift(glm::conjugate(state.grid.world_from_grid.orientation) * wind_mps *
                        (step_s / state.grid.cell_m));
  // Uniform steps in ±a have the deviation a/√3.
  const auto reach = static_cast<float>(state.parameters.jitter_cells * 2.0 *
                                        std::sqrt(3.0 * step_s) * velocity_quantum);
  const auto step = static_cast<float>(step_s) * velocity_quantum;
  const std::uint32_t* const numbers = state.particles.number.data();
  const CellVelocity* const cells = state.field.cells.data();
  const std::uint64_t key = mixed(state.seed + 1), counter = state.tick * max_particles;
  StepReport report = move_particles(
      state, step_s, [&](std::size_t n, int cell, int, int, int, float bias) {
        const CellVelocity& v = cells[cell];
        const auto along = [&](int axis) {
          return (static_cast<float>(v.rest[axis]) + bias * static_cast<float>(v.above[axis])) *
                     step +
                 drift[axis];
        };
        Displacement d{along(0), along(1), along(2)};
        if (v.crowding > 0) [[unlikely]] {
          const auto u = uniform_of(key, (counter + numbers[n]) << 1);
          const float a = reach * static_cast<float>(v.crowding);
          d.dx += a * (2.0f * u[0] - 1.0f);
          d.dy += a * (2.0f * u[1] - 1.0f);
          d.dz += a * (2.0f * u[2] - 1.0f);
        }
        return d;
      });
  report.born = born;
  if (state.tick % extinction_ticks == 0) count_extinction(state);
  leave_soot(state, step_s);
  return report;
}

StepReport advance_smoke_literally(State& state, double step_s) {
  const int born = emit(state, step_s);
  const std::vector<float> table = attraction_table(state.parameters);
  // Densities are those of the step's start for every particle: they change while particles move.
  const State before = [&] {
    State copy;
    copy.grid = state.grid;
    copy.density = state.density;
    copy.full = state.full;
    return copy;
  }();
  const double scale = state.parameters.speed_cells_per_s * step_s;
  StepReport report = move_particles(
      state, step_s, [&](std::size_t, int, int i, int j, int k, float bias) {
        const Vec3 d = scale * mean_sample(before, table, i, j, k, bias);
        return Displacement{static_cast<float>(d.x), static_cast<float>(d.y),
                            static_cast<float>(d.z)};
      });
  report.born = born;
  if (state.tick % extinction_ticks == 0) count_extinction(state);
  return report;
}

void add_to_hash(const State& state, StateHash& hash) {
  const Particles& particles = state.particles;
  hash.add(state.tick);
  hash.add(state.births);
  for (std::size_t n = 0; n < particles.size(); ++n) {
    hash.add(particles.number[n]);
    for (const auto* values : {&particles.x, &particles.y, &particles.z, &particles.age_s})
      hash.add(std::bit_cast<std::uint32_t>((*values)[n]));
  }
}

}  // namespace septet::smoke
