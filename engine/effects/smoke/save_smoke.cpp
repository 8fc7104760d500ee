#include "engine/effects/smoke/save_smoke.hpp"

#include <cmath>

#include "engine/math/transform_members.hpp"

namespace septet::smoke {

SEPTET_MEMBERS(Parameters, steepness, crowd, speed_cells_per_s, jitter_cells, most_in_cell, deposition_mps,
               roof_mirrors, froude, warmth_loss_s)
SEPTET_MEMBERS(Emitter, position_m, radius_m, rate_per_s, heat, cooling_s, sinking, warmth_j, lifetime_s, albedo,
               extinction_area_m2, glow, owed)
SEPTET_MEMBERS(Particles, x, y, z, age_s, emitter, births, number, free_numbers, numbers)
SEPTET_MEMBERS(Warmth, slice_j, slice_j_cells, of_emitter_j)
SEPTET_MEMBERS(Ledger, emitted_m2, left_m2, on_walls_m2, owed_to_walls_m2)
SEPTET_MEMBERS(Grid, world_from_grid, cell_m, nx, ny, nz, open_faces, wall)
SEPTET_MEMBERS(KeyframeTrack, first_chunk, chunks)
SEPTET_MEMBERS(KeyframeTrack::Chunk, time_s, place, known, data)

// Kept is the smoke's place and data that follows from the hashed; left out are the densities, which are counted again,
// and a step's memory.
SEPTET_MEMBER_GROUPS(State, kept(grid),
                     hashed(parameters, emitters, particles, capacity, seed, tick, births, refused, time_s),
                     kept(beside_wall), hashed(soot, ledger), kept(warmth), left_out(density),
                     kept(extinction_area_m2, full), left_out(field))

namespace {

void require_whole(const Grid& grid, StateReader& reader) {
  // Each side is bounded before all are multiplied.
  const auto is_side = [](int n) { return n >= 1 && n <= max_cells_along; };
  if (reader.require(is_side(grid.nx) && is_side(grid.ny) && is_side(grid.nz) &&
                         std::int64_t{grid.nx} * grid.ny * grid.nz <= max_cells && std::isfinite(grid.cell_m) &&
                         grid.cell_m > 0.0,
                     "the smoke's grid in it is out of bounds"))
    reader.require(grid.wall.size() == static_cast<std::size_t>(grid.cells()),
                   "the smoke's walls in it are not its box's");
}

void require_whole(const State& state, StateReader& reader) {
  constexpr auto wrong = "smoke in it does not fit together";
  const Particles& particles = state.particles;
  const auto cells = static_cast<std::size_t>(state.grid.cells());
  const std::size_t count = particles.size();
  const Parameters& parameters = state.parameters;
  reader.require(parameters.crowd > 0.0 && std::isfinite(parameters.crowd) && parameters.crowd < 1e4 &&
                     parameters.steepness > 0.0 && state.emitters.size() <= max_emitters &&
                     state.capacity <= max_particles && count <= state.capacity && particles.numbers <= max_particles &&
                     state.extinction_area_m2.size() == cells && state.full.size() == cells &&
                     state.soot.size() == state.beside_wall.size() &&
                     state.warmth.slice_j.size() == static_cast<std::size_t>(state.grid.nx) &&
                     state.warmth.slice_j_cells.size() == state.warmth.slice_j.size(),
                 wrong);
  for (const auto* values : {&particles.y, &particles.z, &particles.age_s})
    reader.require(values->size() == count, wrong);
  reader.require(particles.emitter.size() == count && particles.number.size() == count &&
                     particles.births.size() == count && particles.free_numbers.size() + count == particles.numbers,
                 wrong);
  for (const std::uint32_t cell : state.beside_wall) reader.require(cell < cells, wrong);
  for (const Emitter& emitter : state.emitters)
    reader.require(std::abs(emitter.rate_per_s) <= 1e6 && emitter.owed >= 0.0 && emitter.owed <= 1e6 &&
                       std::isfinite(emitter.radius_m),
                   wrong);
  if (!reader.ok()) return;
  std::vector<bool> taken(particles.numbers, false);
  const auto take = [&](std::uint32_t number) {
    if (reader.require(number < taken.size() && !taken[number], wrong)) taken[number] = true;
  };
  for (std::size_t n = 0; n < count && reader.ok(); ++n) {
    const auto is_within = [](float value, int limit) { return value >= 0.0f && value < static_cast<float>(limit); };
    reader.require(is_within(particles.x[n], state.grid.nx) && is_within(particles.y[n], state.grid.ny) &&
                       is_within(particles.z[n], state.grid.nz) && particles.emitter[n] < state.emitters.size() &&
                       particles.age_s[n] >= 0.0f && std::isfinite(particles.age_s[n]),
                   wrong);
    take(particles.number[n]);
  }
  for (const std::uint32_t number : particles.free_numbers) take(number);
}

void require_whole(const KeyframeTrack& track, const State& state, StateReader& reader) {
  reader.require(track.first_chunk + track.chunks.size() <= max_chunks &&
                     track.chunks.size() * chunk_slots < state.particles.numbers + chunk_slots &&
                     (state.particles.numbers + chunk_slots - 1) / chunk_slots + track.first_chunk <= max_chunks,
                 "keyframes in it are not its smoke's");
  for (const auto& chunk : track.chunks)
    reader.require(chunk.place.size() == chunk.known.size() && chunk.place.size() <= chunk_slots,
                   "keyframes in it are not its smoke's");
  for (const auto& chunk : track.chunks)
    for (const auto& place : chunk.place)
      for (const std::int32_t along : place)
        reader.require(along >= 0 && along <= max_cells_along * steps_per_cell, "keyframes in it are not its smoke's");
}

}  // namespace

void add_to_hash(const State& state, StateHash& hash) { hash_members(hash, state); }

void save_smoke(const State& state, const KeyframeTrack& track, StateWriter& writer) {
  transfer(writer, state);
  transfer(writer, track);
}

void restore_smoke(StateReader& reader, State& state, KeyframeTrack& track) {
  transfer(reader, state);
  transfer(reader, track);
  require_whole(state.grid, reader);
  if (!reader.ok()) return;
  require_whole(state, reader);
  require_whole(track, state, reader);
  const auto cells = static_cast<std::size_t>(state.grid.cells());
  if (!reader.ok() || !reader.take_memory(cells * sizeof(std::uint16_t))) return;
  const Particles& particles = state.particles;
  state.density.assign(cells, 0);
  for (std::size_t n = 0; n < particles.size(); ++n)
    ++state.density[state.grid.index(static_cast<int>(particles.x[n]), static_cast<int>(particles.y[n]),
                                     static_cast<int>(particles.z[n]))];
}

}  // namespace septet::smoke
