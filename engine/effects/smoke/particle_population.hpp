#pragma once
/// Population of particles: births, deaths, and the way out of cells that became full.

#include <optional>

#include "engine/effects/smoke/smoke_state.hpp"

namespace septet::smoke {

inline std::uint64_t mixed(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
  return bits ^ (bits >> 31);
}

/// Three independent numbers in [0, 1) from a key (SplitMix64's mixing of a seed) and a counter: the same for any place
/// and order of the calls.
inline std::array<float, 3> uniform_of(std::uint64_t key, std::uint64_t counter) {
  const std::uint64_t bits = mixed(key + counter * 0x9e3779b97f4a7c15u);
  constexpr float scale = 1.0f / (1 << 21);
  return {static_cast<float>(static_cast<std::int32_t>(bits & 0x1fffff)) * scale,
          static_cast<float>(static_cast<std::int32_t>((bits >> 21) & 0x1fffff)) * scale,
          static_cast<float>(static_cast<std::int32_t>((bits >> 42) & 0x1fffff)) * scale};
}

struct CellPlace {
  int i, j, k;
};
/// The nearest cell that is not full and has room for one more, within six cells; of equally near ones the lowest, then
/// the first.
std::optional<CellPlace> nearest_free_cell(const State& state, int i, int j, int k);

/// The last particle takes its place. The density of its cell is the caller's to lower.
void remove_particle(Particles& particles, std::size_t at);

/// Puts the particles into the order of their cells. Numbers stay.
void sort_by_cell(State& state);

/// Joins neighbours of one emitter whose particles stay for ever, the lightest first, until an eighth of the capacity
/// is free again; cross-sections and warmth stay. Wants particles in order (sort_by_cell). Returns the number joined.
int join_neighbours(State& state);

/// Adds the births of a step; returns their number.
int emit(State& state, double step_s);

}  // namespace septet::smoke
