#pragma once
/// The paper's room, and a tunnel with a fire.

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/effects/smoke/smoke_state.hpp"
#include "tests/engine/effects/smoke/tunnel_grid.hpp"

namespace septet::smoke {

inline constexpr double step_s = 1.0 / 60.0;

/// A closed room of 24 × 24 × 16 cells of one metre, and a fire on its floor that emits 18,432 particles in 25 s.
inline State paper_room(std::uint64_t seed = 1) {
  Emitter fire;
  fire.position_m = {12.0, 12.0, 2.0};
  fire.radius_m = 1.0;
  fire.rate_per_s = 18432.0 / 25.0;
  fire.heat = 0.5;
  fire.cooling_s = 10.0;
  fire.lifetime_s = 0.0;
  Parameters parameters;
  parameters.deposition_mps = 0.0;
  return make_smoke(make_grid({}, 1.0, 24, 24, 16, 0), {fire}, seed, 20000, parameters);
}

/// 120 m of a road tunnel, 11 m wide and 7 m high, with a burning car in the middle.
inline State tunnel_fire(std::uint64_t seed = 1, std::size_t capacity = 20000, double cell_m = 1.0) {
  RigidTransform world_from_floor;
  world_from_floor.position_m = {5000.0, -300.0, 40.0};
  world_from_floor.orientation = orientation_from_angles(0.7, 0.0, 0.0);
  Emitter fire;
  fire.position_m = world_from_floor * Vec3(60.0, 0.0, 1.5);
  fire.radius_m = 1.2;
  fire.rate_per_s = 600.0;
  fire.heat = 0.5;
  fire.cooling_s = 10.0;
  fire.lifetime_s = 40.0;
  fire.extinction_area_m2 = 0.6;
  fire.glow = 0.8;
  return make_smoke(make_tunnel_grid(world_from_floor, cell_m, 120.0, 5.5, 4.0, 7.0), {fire}, seed, capacity);
}

struct Layers {
  double mean = 0.0;                 ///< Height as a share of the room's.
  std::array<double, 4> quarters{};  ///< Share of the particles in each, from below.
  int most = 0;                      ///< In one cell.
  double variation = 0.0;            ///< Standard deviation of the density over its mean.
};

inline Layers layers_of(const State& state) {
  Layers layers;
  const Particles& particles = state.particles;
  const double count = static_cast<double>(particles.size());
  for (const float z : particles.z) {
    const double height = z / state.grid.nz;
    layers.mean += height / count;
    layers.quarters[static_cast<std::size_t>(height * 4.0)] += 1.0 / count;
  }
  double squares = 0.0;
  for (const std::uint16_t density : state.density) {
    layers.most = std::max<int>(layers.most, density);
    squares += double{static_cast<double>(density)} * density;
  }
  const double mean = count / static_cast<double>(state.density.size());
  layers.variation = std::sqrt(squares / static_cast<double>(state.density.size()) - mean * mean) / mean;
  return layers;
}

inline std::size_t particles_in_full_cells(const State& state) {
  std::size_t found = 0;
  const Particles& p = state.particles;
  for (std::size_t n = 0; n < p.size(); ++n) {
    const int i = static_cast<int>(std::floor(p.x[n])), j = static_cast<int>(std::floor(p.y[n])),
              k = static_cast<int>(std::floor(p.z[n]));
    found += !state.grid.inside(i, j, k) || state.full[state.grid.index(i, j, k)] != 0;
  }
  return found;
}

}  // namespace septet::smoke
