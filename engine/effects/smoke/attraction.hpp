#pragma once
/// The 46 samples and the attraction of a cell: the paper's update, literally.
///
/// The pattern (figures 3–5): 26 neighbours; a five-point quincunx on each face of the cube two cells away, which is
/// its 8 corners and 6 face centres; 6 samples three cells away. Attraction (figure 6): 1 in an empty cell, 0 at the
/// crowd, −1 in a full one. The denominator is that of the pseudo-code, Σ|f|: figure 1's Σf can cross zero.

#include <array>
#include <span>
#include <vector>

#include "engine/effects/smoke/smoke_state.hpp"

namespace septet::smoke {

struct SampleOffset {
  int x, y, z;
};
const std::array<SampleOffset, 46>& sample_pattern();

/// f of a density, from 1 at none to −1 at twice the crowd and beyond; 0 at the crowd.
double attraction(double density, const Parameters& parameters);

/// f for 0, 1, … particles; the last entry, −1, holds for every greater density and for full cells.
std::vector<float> attraction_table(const Parameters& parameters);

/// Figure 1 for one particle in a cell, read sample by sample from the densities; `bias` multiplies the samples above.
/// In cells; times Parameters::speed_cells_per_s it is the particle's velocity.
Vec3 mean_sample(const State& state, std::span<const float> table, int i, int j, int k, double bias);

/// One tick as published: no jitter, wind, obstacles or soot. For comparison; set `most_in_cell` to 65535 for it.
StepReport advance_smoke_literally(State& state, double step_s);

}  // namespace septet::smoke
