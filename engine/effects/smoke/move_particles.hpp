#pragma once
/// The step of every particle, for any source of velocities.
///
/// Particles are processed in blocks, a few loops over each: the steps common to all use whole vectors, and the few
/// exceptions (death, a change of cell) are listed first and followed one by one, so that there is no unpredictable
/// branch for each particle.

#include <array>
#include <functional>

#include "engine/effects/smoke/particle_population.hpp"

namespace septet::smoke {

struct Block {
  static constexpr int most = 256;
  std::size_t first = 0;  ///< Index of the first particle.
  int count = 0;
  std::array<int, most> cell;                    ///< Cells of the particles.
  std::array<float, most> bias;                  ///< Bias of the samples above the particles.
  alignas(32) std::array<float, 4 * most> step;  ///< Output: x, y, z and one unused for each; cells in the whole step.
};

/// Indices of 0 … count − 1 for which `chosen` holds, in their order. Branch-free.
template <class Chosen>
int list_of(int count, std::array<std::uint16_t, Block::most>& list, Chosen&& chosen) {
  int found = 0;
  for (int n = 0; n < count; ++n) {
    list[static_cast<std::size_t>(found)] = static_cast<std::uint16_t>(n);
    found += chosen(n) ? 1 : 0;
  }
  return found;
}

/// Ages every particle, lets it die or leave, moves it by the step from `fill_steps`, and updates the densities.
StepReport move_particles(State& state, double step_s, const std::function<void(Block&)>& fill_steps);

/// Moves particles out of cells that became full; returns their number.
int push_out_of_full_cells(State& state);

}  // namespace septet::smoke
