#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/core/check.hpp"
#include "engine/effects/smoke/attraction.hpp"
#include "engine/effects/smoke/move_particles.hpp"

namespace septet::smoke {
namespace {

constexpr std::uint64_t sorting_ticks = 32;

/// Fills every cell whose centre a box covers, and those that it overlaps by at least a quarter of a cell. Returns true
/// where any of them has smoke.
bool mark_full(State& state, std::span<const Obstacle> obstacles) {
  bool smoke_within = false;
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
          if (!(std::abs(p.x) <= half.x && std::abs(p.y) <= half.y && std::abs(p.z) <= half.z)) continue;
          const int cell = grid.index(i, j, k);
          state.full[cell] = 1;
          smoke_within = smoke_within || state.density[cell] != 0;
        }
  }
  return smoke_within;
}

/// Parameters of a particle's step in a tick: (rest + bias·above)·scale + drift, and uniform steps in ±jitter for each
/// unit of its cell's crowding.
struct Motion {
  float scale = 0.0f, jitter = 0.0f;
  glm::vec3 drift{0.0f};
  std::uint64_t key = 0, counter = 0;  ///< Key of the random numbers; a particle adds its own.
};

/// A cell's velocity is one load, one widening and one conversion of eight numbers.
void fill_steps(const CellVelocity* cells, const std::uint32_t* numbers, const Motion& motion, Block& block) {
  using Shorts = std::int16_t __attribute__((vector_size(16)));
  using Integers = std::int32_t __attribute__((vector_size(32)));
  using Floats = float __attribute__((vector_size(32)));
  using Half = float __attribute__((vector_size(16)));
  const Half drift{motion.drift.x, motion.drift.y, motion.drift.z, 0.0f};
  for (int n = 0; n < block.count; ++n) {
    Shorts packed;
    std::memcpy(&packed, cells + block.cell[static_cast<std::size_t>(n)], sizeof packed);
    const Floats v = __builtin_convertvector(__builtin_convertvector(packed, Integers), Floats);
    const Half rest = __builtin_shufflevector(v, v, 0, 1, 2, 3), above = __builtin_shufflevector(v, v, 4, 5, 6, 7);
    const Half step = (rest + block.bias[static_cast<std::size_t>(n)] * above) * motion.scale + drift;
    std::memcpy(&block.step[static_cast<std::size_t>(4 * n)], &step, sizeof step);
  }
  std::array<std::uint16_t, Block::most> crowded;
  const auto crowding = [&](std::size_t n) { return cells[block.cell[n]].crowding; };
  const int count = list_of(block.count, crowded, [&](int n) { return crowding(static_cast<std::size_t>(n)) > 0; });
  for (int c = 0; c < count; ++c) {
    const std::size_t n = crowded[static_cast<std::size_t>(c)];
    const auto u = uniform_of(motion.key, (motion.counter + numbers[block.first + n]) << 1);
    const float a = motion.jitter * static_cast<float>(crowding(n));
    for (std::size_t axis = 0; axis < 3; ++axis) block.step[4 * n + axis] += a * (2.0f * u[axis] - 1.0f);
  }
}

/// Joined particles crowd as their births would: each counts as many as the mean.
Parameters crowd_of_joined(const State& state) {
  Parameters parameters = state.parameters;
  std::uint64_t births = 0;
  for (const std::uint16_t n : state.particles.births) births += n;
  if (births == state.particles.size()) return parameters;
  const double mean = static_cast<double>(births) / static_cast<double>(state.particles.size());
  parameters.crowd /= mean;
  parameters.steepness *= mean;
  return parameters;
}

void count_extinction(State& state) {
  const Particles& particles = state.particles;
  struct Look {
    float area_m2, per_lifetime, warmth_j;
  };
  std::vector<Look> looks;
  Warmth& warmth = state.warmth;
  std::ranges::fill(warmth.slice_j, 0.0f);
  std::ranges::fill(warmth.slice_j_cells, 0.0f);
  warmth.of_emitter_j.fill(0.0f);
  const auto per_loss_s = static_cast<float>(1.0 / state.parameters.warmth_loss_s);
  for (const Emitter& e : state.emitters)
    looks.push_back({static_cast<float>(e.extinction_area_m2),
                     e.lifetime_s > 0.0 ? static_cast<float>(1.0 / e.lifetime_s) : 0.0f,
                     static_cast<float>(e.warmth_j)});
  std::fill(state.extinction_area_m2.begin(), state.extinction_area_m2.end(), 0.0f);
  for (std::size_t n = 0; n < particles.size(); ++n) {
    const Look& look = looks[particles.emitter[n]];
    const int cell = state.grid.index(static_cast<int>(particles.x[n]), static_cast<int>(particles.y[n]),
                                      static_cast<int>(particles.z[n]));
    const auto births = static_cast<float>(particles.births[n]);
    state.extinction_area_m2[cell] +=
        look.area_m2 * births * static_cast<float>(remaining_extinction(particles.age_s[n] * look.per_lifetime));
    if (!(look.warmth_j > 0.0f)) continue;
    const float left_j = look.warmth_j * births * remaining_warmth(particles.age_s[n], per_loss_s);
    const auto slice = static_cast<std::size_t>(particles.x[n]);
    warmth.slice_j[slice] += left_j;
    warmth.slice_j_cells[slice] += left_j * particles.z[n];
    warmth.of_emitter_j[particles.emitter[n]] += left_j;
  }
}

/// Cross-section in a cell and around it: a particle is a ball with the deviation of one cell, as it is drawn. (Few come
/// into the cell itself, because walls repel.)
float area_around_m2(const State& state, std::uint32_t cell) {
  constexpr std::array<float, 5> weight{0.054f, 0.242f, 0.399f, 0.242f, 0.054f};
  const Grid& grid = state.grid;
  const int at = static_cast<int>(cell), i = at % grid.nx, j = at / grid.nx % grid.ny, k = at / (grid.nx * grid.ny);
  float sum = 0.0f;
  for (int dk = std::max(-2, -k); dk <= std::min(2, grid.nz - 1 - k); ++dk)
    for (int dj = std::max(-2, -j); dj <= std::min(2, grid.ny - 1 - j); ++dj)
      for (int di = std::max(-2, -i); di <= std::min(2, grid.nx - 1 - i); ++di)
        if (const float area_m2 = state.extinction_area_m2[grid.index(i + di, j + dj, k + dk)]; area_m2 > 0.0f)
          sum += weight[di + 2] * weight[dj + 2] * weight[dk + 2] * area_m2;
  return sum;
}

bool is_wall(const Grid& grid, int i, int j, int k) {
  return grid.inside(i, j, k) ? grid.wall[grid.index(i, j, k)] != 0 : !is_open(grid, i, j, k);
}

bool touches_wall(const Grid& grid, int i, int j, int k) {
  return is_wall(grid, i - 1, j, k) || is_wall(grid, i + 1, j, k) || is_wall(grid, i, j - 1, k) ||
         is_wall(grid, i, j + 1, k) || is_wall(grid, i, j, k - 1) || is_wall(grid, i, j, k + 1);
}

/// Adds soot to a 32nd of the walls a tick, for 32 ticks' time.
void leave_soot(State& state, double step_s) {
  constexpr std::size_t slices = 32;
  const std::size_t slice = state.tick % slices, count = state.beside_wall.size();
  const double cell_m2 = state.grid.cell_m * state.grid.cell_m;
  const auto per_area = static_cast<float>(state.parameters.deposition_mps * slices * step_s /
                                           (full_layer_depth * cell_m2 * state.grid.cell_m));
  double layers = 0.0;
  for (std::size_t n = count * slice / slices; n < count * (slice + 1) / slices; ++n) {
    const float more = per_area * area_around_m2(state, state.beside_wall[n]);
    state.soot[n] += more;
    layers += more;
  }
  state.ledger.on_walls_m2 += layers * full_layer_depth * cell_m2;
  state.ledger.owed_to_walls_m2 += layers * full_layer_depth * cell_m2;
}

/// Takes the soot on the walls out of the air beside them, a birth at a time.
void take_from_air(State& state) {
  Particles& p = state.particles;
  const Grid& grid = state.grid;
  constexpr int tries_a_tick = 256;
  const std::uint64_t key = mixed(state.seed + 2), first = state.tick * tries_a_tick;
  for (int n = 0; n < tries_a_tick && state.ledger.owed_to_walls_m2 > 0.0 && p.size() > 0; ++n) {
    const auto at = static_cast<std::size_t>(uniform_of(key, first + n)[0] * static_cast<float>(p.size()));
    const Emitter& emitter = state.emitters[p.emitter[at]];
    if (emitter.lifetime_s > 0.0 || emitter.extinction_area_m2 > state.ledger.owed_to_walls_m2) continue;
    const int i = static_cast<int>(p.x[at]), j = static_cast<int>(p.y[at]), k = static_cast<int>(p.z[at]);
    if (!touches_wall(grid, i, j, k)) continue;
    const double taken = std::min<double>(
        p.births[at], std::floor(state.ledger.owed_to_walls_m2 / std::max(1e-6, emitter.extinction_area_m2)));
    state.ledger.owed_to_walls_m2 -= taken * emitter.extinction_area_m2;
    p.births[at] = static_cast<std::uint16_t>(p.births[at] - static_cast<std::uint16_t>(taken));
    if (p.births[at] > 0) continue;
    --state.density[grid.index(i, j, k)];
    remove_particle(p, at);
  }
}

std::vector<std::uint32_t> cells_beside_walls(const Grid& grid) {
  std::vector<std::uint32_t> cells;
  for (int k = 0; k < grid.nz; ++k)
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i)
        if (!is_wall(grid, i, j, k) && touches_wall(grid, i, j, k))
          cells.push_back(static_cast<std::uint32_t>(grid.index(i, j, k)));
  return cells;
}

}  // namespace

State make_smoke(const Grid& grid, std::vector<Emitter> emitters, std::uint64_t seed, std::size_t capacity,
                 const Parameters& parameters) {
  SEPTET_CHECK(emitters.size() <= max_emitters, "{} emitters", emitters.size());
  SEPTET_CHECK(parameters.crowd > 0.0 && parameters.steepness > 0.0, "crowd {}, steepness {}", parameters.crowd,
               parameters.steepness);
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
  state.warmth.slice_j.assign(static_cast<std::size_t>(grid.nx), 0.0f);
  state.warmth.slice_j_cells.assign(static_cast<std::size_t>(grid.nx), 0.0f);
  return state;
}

StepReport advance_smoke(State& state, const Vec3& wind_mps, std::span<const Obstacle> obstacles, double step_s) {
  SEPTET_CHECK(step_s > 0.0 && step_s <= 0.1, "step of {} s", step_s);
  const int pushed = mark_full(state, obstacles) ? push_out_of_full_cells(state) : 0;
  int joined = 0;
  const int born = emit(state, step_s);
  if (state.tick % sorting_ticks == 0) {
    sort_by_cell(state);
    if (state.particles.size() > state.capacity - state.capacity / 16) joined = join_neighbours(state);
  }
  const std::vector<float> table = attraction_table(crowd_of_joined(state));
  update_velocity_field(state, table, state.field);
  Motion motion;
  motion.scale = static_cast<float>(step_s) * velocity_quantum;
  motion.drift =
      glm::vec3(glm::conjugate(state.grid.world_from_grid.orientation) * wind_mps * (step_s / state.grid.cell_m));
  // Uniform steps in ±a have the deviation a/√3.
  motion.jitter = static_cast<float>(state.parameters.jitter_cells * 2.0 * std::sqrt(3.0 * step_s) * velocity_quantum);
  motion.key = mixed(state.seed + 1);
  motion.counter = state.tick * max_particles;
  const CellVelocity* const cells = state.field.cells.data();
  StepReport report = move_particles(
      state, step_s, [&](Block& block) { fill_steps(cells, state.particles.number.data(), motion, block); });
  report.pushed = pushed;
  report.born = born;
  report.joined = joined;
  if (state.tick % extinction_ticks == 0) count_extinction(state);
  leave_soot(state, step_s);
  take_from_air(state);
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
  StepReport report = move_particles(state, step_s, [&](Block& block) {
    for (int n = 0; n < block.count; ++n) {
      const int cell = block.cell[static_cast<std::size_t>(n)], nx = state.grid.nx, ny = state.grid.ny;
      const Vec3 d = scale * mean_sample(before, table, cell % nx, cell / nx % ny, cell / (nx * ny),
                                         block.bias[static_cast<std::size_t>(n)]);
      for (int axis = 0; axis < 3; ++axis)
        block.step[static_cast<std::size_t>(4 * n + axis)] = static_cast<float>(d[axis]);
    }
  });
  report.born = born;
  if (state.tick % extinction_ticks == 0) count_extinction(state);
  return report;
}

}  // namespace septet::smoke
