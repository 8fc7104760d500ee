#pragma once
/// The step that every particle makes, whatever its velocity comes from.

#include <algorithm>

#include "engine/effects/smoke/particle_population.hpp"

namespace septet::smoke {

/// Moves a particle by (dx, dy, dz) cells, an axis at a time, never into a full or crowded cell and never more than one
/// cell, so that it slides along walls. False: it left through an open face.
inline bool move_within(const Grid& grid, const std::uint8_t* full, const std::uint16_t* density,
                        std::uint16_t most, float& x, float& y, float& z, float dx, float dy, float dz, int& i, int& j, int& k) {
  constexpr float furthest = 0.95f;
  // Most steps stay within the cell. (Conversion rounds towards zero: below it, −1 would look like 0.)
  const float tx = x + dx, ty = y + dy, tz = z + dz;
  if (static_cast<int>(tx) == i && static_cast<int>(ty) == j && static_cast<int>(tz) == k &&
      std::min(std::min(tx, ty), tz) >= 0.0f) {
    x = tx, y = ty, z = tz;
    return true;
  }
  const auto along = [&](float& at, int& cell, float by, int count, std::uint8_t low,
                         std::uint8_t high, int others, int stride) {
    by = std::min(std::max(by, -furthest), furthest);
    const float to = at + by;
    const int next = to < 0.0f ? -1 : static_cast<int>(to);
    if (next != cell) {
      if (next < 0 || next >= count) return (grid.open_faces & (next < 0 ? low : high)) == 0;
      const int target = others + next * stride;
      if (full[target] || density[target] >= most) return true;
      cell = next;
    }
    at = to;
    return true;
  };
  const int ny = grid.ny, nx = grid.nx;
  return along(x, i, dx, nx, open_x_low, open_x_high, (k * ny + j) * nx, 1) &&
         along(y, j, dy, ny, open_y_low, open_y_high, k * ny * nx + i, nx) &&
         along(z, k, dz, grid.nz, open_z_low, open_z_high, j * nx + i, nx * ny);
}

/// Ages every particle, lets it die or leave, moves it by what `displacement(n, cell, i, j, k, bias)` says (cells, in
/// the whole step), and keeps the densities.
template <class Displacement>
StepReport move_particles(State& state, double step_s, Displacement&& displacement) {
  const Grid& grid = state.grid;
  Particles& particles = state.particles;
  StepReport report;
  struct Birth {
    float heat, per_cooling, lifetime_s;
  };
  std::vector<Birth> births;
  for (const Emitter& e : state.emitters)
    births.push_back({static_cast<float>(e.heat),
                      e.cooling_s > 0.0 ? static_cast<float>(1.0 / e.cooling_s) : 1e9f,
                      static_cast<float>(e.lifetime_s)});
  const auto step = static_cast<float>(step_s);
  const std::uint8_t* const full = state.full.data();
  std::uint16_t* const density = state.density.data();
  const std::uint16_t most = state.parameters.most_in_cell;
  for (std::size_t n = 0; n < particles.size();) {
    float& age = particles.age_s[n];
    const Birth& birth = births[particles.emitter[n]];
    age += step;
    float &x = particles.x[n], &y = particles.y[n], &z = particles.z[n];
    int i = static_cast<int>(x), j = static_cast<int>(y), k = static_cast<int>(z);
    const int cell = (k * grid.ny + j) * grid.nx + i;
    if (birth.lifetime_s > 0.0f && age >= birth.lifetime_s) {
      --density[cell];
      remove_particle(particles, n);
      ++report.died;
      continue;
    }
    if (full[cell]) {
      if (const auto place = nearest_free_cell(state, i, j, k)) {
        x = static_cast<float>(place->i) + 0.5f;
        y = static_cast<float>(place->j) + 0.5f;
        z = static_cast<float>(place->k) + 0.5f;
        --density[cell];
        ++density[grid.index(place->i, place->j, place->k)];
        ++report.pushed;
      }
    } else {
      const float bias = 1.0f + birth.heat * std::max(0.0f, 1.0f - age * birth.per_cooling);
      const auto [dx, dy, dz] = displacement(n, cell, i, j, k, bias);
      if (!move_within(grid, full, density, most, x, y, z, dx, dy, dz, i, j, k)) {
        --density[cell];
        remove_particle(particles, n);
        ++report.left;
        continue;
      }
      const int next = (k * grid.ny + j) * grid.nx + i;
      if (next != cell) {
        --density[cell];
        ++density[next];
      }
    }
    ++n;
  }
  ++state.tick;
  state.time_s += step_s;
  return report;
}

}  // namespace septet::smoke
