#include "engine/effects/smoke/move_particles.hpp"

#include <algorithm>

namespace septet::smoke {
namespace {

/// Effect of a particle's age on it, by its emitter.
struct Ageing {
  std::array<float, 256> heat{}, per_cooling{}, coldest{}, lifetime_s{};  // As many as an index can name.

  explicit Ageing(const State& state) {
    lifetime_s.fill(INFINITY);
    for (std::size_t n = 0; n < state.emitters.size(); ++n) {
      const Emitter& e = state.emitters[n];
      heat[n] = static_cast<float>(e.heat);
      coldest[n] = -static_cast<float>(e.sinking);
      per_cooling[n] = e.cooling_s > 0.0 ? static_cast<float>(1.0 / e.cooling_s) : 1e9f;
      if (e.lifetime_s > 0.0) lifetime_s[n] = static_cast<float>(e.lifetime_s);
    }
  }
};

/// Removes the particles at these places (ascending): each one's place goes to the last, which stays or went before.
void remove(State& state, const std::vector<std::size_t>& places) {
  const Particles& particles = state.particles;
  for (std::size_t n = places.size(); n-- > 0;) {
    const std::size_t at = places[n];
    --state.density[state.grid.index(static_cast<int>(particles.x[at]), static_cast<int>(particles.y[at]),
                                     static_cast<int>(particles.z[at]))];
    remove_particle(state.particles, at);
  }
}

int age(State& state, const Ageing& ageing, float step_s) {
  std::vector<std::size_t> dead;
  const std::size_t count = state.particles.size();
  for (std::size_t first = 0; first < count; first += Block::most) {
    const int here = static_cast<int>(std::min<std::size_t>(Block::most, count - first));
    float* __restrict age_s = state.particles.age_s.data() + first;
    const std::uint8_t* __restrict emitter = state.particles.emitter.data() + first;
    int any = 0;
    for (int n = 0; n < here; ++n) {
      age_s[n] += step_s;
      any |= age_s[n] >= ageing.lifetime_s[emitter[n]] ? 1 : 0;
    }
    for (int n = 0; n < here && any; ++n)
      if (age_s[n] >= ageing.lifetime_s[emitter[n]]) dead.push_back(first + static_cast<std::size_t>(n));
  }
  remove(state, dead);
  return static_cast<int>(dead.size());
}

void locate(const State& state, const Ageing& ageing, Block& block) {
  const Particles& particles = state.particles;
  const float* __restrict x = particles.x.data() + block.first;
  const float* __restrict y = particles.y.data() + block.first;
  const float* __restrict z = particles.z.data() + block.first;
  const float* __restrict age_s = particles.age_s.data() + block.first;
  const std::uint8_t* __restrict emitter = particles.emitter.data() + block.first;
  int* __restrict cell = block.cell.data();
  float* __restrict bias = block.bias.data();
  const int nx = state.grid.nx, ny = state.grid.ny, count = block.count;
  for (int n = 0; n < count; ++n)
    cell[n] = (static_cast<int>(z[n]) * ny + static_cast<int>(y[n])) * nx + static_cast<int>(x[n]);
  for (int n = 0; n < count; ++n)
    bias[n] = 1.0f + std::max(ageing.coldest[emitter[n]],
                              ageing.heat[emitter[n]] * (1.0f - age_s[n] * ageing.per_cooling[emitter[n]]));
}

/// Moves the particles that stay in their cell, which are most, and marks the others.
void move_within_cells(int count, const float* __restrict step, float* __restrict x, float* __restrict y,
                       float* __restrict z, int* __restrict crosses) {
  for (int n = 0; n < count; ++n) {
    const float from_x = x[n], from_y = y[n], from_z = z[n];
    const float to_x = from_x + step[4 * n], to_y = from_y + step[4 * n + 1], to_z = from_z + step[4 * n + 2];
    // Conversion rounds towards zero: below it, −1 would look like 0, except for its sign.
    const int changes = (static_cast<int>(to_x) ^ static_cast<int>(from_x)) |
                        (static_cast<int>(to_y) ^ static_cast<int>(from_y)) |
                        (static_cast<int>(to_z) ^ static_cast<int>(from_z));
    const float least = std::min(std::min(to_x, to_y), to_z);
    const int crossing = changes | (least < 0.0f ? 1 : 0);
    const float share = crossing ? 0.0f : 1.0f;
    x[n] = from_x + share * step[4 * n];
    y[n] = from_y + share * step[4 * n + 1];
    z[n] = from_z + share * step[4 * n + 2];
    crosses[n] = crossing;
  }
}

/// Moves a particle an axis at a time, never into a full or crowded cell and never more than one cell, so that it
/// slides along walls. False: it left through an open face; it is still counted in its cell.
bool move_between_cells(State& state, std::size_t at, int cell, const float* step) {
  constexpr float furthest = 0.95f;
  const Grid& grid = state.grid;
  float &x = state.particles.x[at], &y = state.particles.y[at], &z = state.particles.z[at];
  float to_x = x, to_y = y, to_z = z;
  int i = static_cast<int>(x), j = static_cast<int>(y), k = static_cast<int>(z);
  const auto along = [&](float& place, int& index, float by, int count, std::uint8_t low, std::uint8_t high, int others,
                         int stride) {
    const float to = place + std::min(std::max(by, -furthest), furthest);
    const int next = to < 0.0f ? -1 : static_cast<int>(to);
    if (next != index) {
      if (next < 0 || next >= count) return (grid.open_faces & (next < 0 ? low : high)) == 0;
      const int target = others + next * stride;
      if (state.full[target] || state.density[target] >= state.parameters.most_in_cell) return true;
      index = next;
    }
    place = to;
    return true;
  };
  const int ny = grid.ny, nx = grid.nx;
  if (!along(to_x, i, step[0], nx, open_x_low, open_x_high, (k * ny + j) * nx, 1) ||
      !along(to_y, j, step[1], ny, open_y_low, open_y_high, k * ny * nx + i, nx) ||
      !along(to_z, k, step[2], grid.nz, open_z_low, open_z_high, j * nx + i, nx * ny))
    return false;
  x = to_x, y = to_y, z = to_z;
  --state.density[cell];
  ++state.density[grid.index(i, j, k)];
  return true;
}

}  // namespace

StepReport move_particles(State& state, double step_s, const std::function<void(Block&)>& fill_steps) {
  StepReport report;
  const Ageing ageing(state);
  report.died = age(state, ageing, static_cast<float>(step_s));
  std::vector<std::size_t> left;
  std::array<std::uint16_t, Block::most> list;
  std::array<int, Block::most> crosses;
  Block block;
  const std::size_t count = state.particles.size();
  for (; block.first < count; block.first += Block::most) {
    block.count = static_cast<int>(std::min<std::size_t>(Block::most, count - block.first));
    locate(state, ageing, block);
    fill_steps(block);
    Particles& p = state.particles;
    move_within_cells(block.count, block.step.data(), p.x.data() + block.first, p.y.data() + block.first,
                      p.z.data() + block.first, crosses.data());
    const int crossing = list_of(block.count, list, [&](int n) { return crosses[static_cast<std::size_t>(n)] != 0; });
    for (int c = 0; c < crossing; ++c) {
      const std::size_t n = list[static_cast<std::size_t>(c)];
      if (!move_between_cells(state, block.first + n, block.cell[n], &block.step[4 * n]))
        left.push_back(block.first + n);
    }
  }
  for (const std::size_t n : left)
    if (const Emitter& e = state.emitters[state.particles.emitter[n]]; !(e.lifetime_s > 0.0))
      state.ledger.left_m2 += e.extinction_area_m2 * state.particles.births[n];
  remove(state, left);
  report.left = static_cast<int>(left.size());
  ++state.tick;
  state.time_s += step_s;
  return report;
}

int push_out_of_full_cells(State& state) {
  Particles& particles = state.particles;
  int pushed = 0;
  for (std::size_t n = 0; n < particles.size(); ++n) {
    const int i = static_cast<int>(particles.x[n]), j = static_cast<int>(particles.y[n]),
              k = static_cast<int>(particles.z[n]);
    const int cell = state.grid.index(i, j, k);
    if (!state.full[cell]) continue;
    const auto place = nearest_free_cell(state, i, j, k);
    if (!place) continue;
    particles.x[n] = static_cast<float>(place->i) + 0.5f;
    particles.y[n] = static_cast<float>(place->j) + 0.5f;
    particles.z[n] = static_cast<float>(place->k) + 0.5f;
    --state.density[cell];
    ++state.density[state.grid.index(place->i, place->j, place->k)];
    ++pushed;
  }
  return pushed;
}

}  // namespace septet::smoke
