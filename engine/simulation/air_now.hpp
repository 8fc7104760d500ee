#pragma once
/// The air of this tick, as light passes it: fog, what falls, smoke, and the light of the sky.
///
/// SI units; lux. Pure functions.

#include "engine/sight/air.hpp"
#include "engine/simulation/state.hpp"

namespace septet::simulation {

struct Air {
  const smoke::State* smoke = nullptr;
  double per_m = 0.0;  ///< Extinction by fog and what falls.
  double natural_lx = 0.0;
};

/// The state must live as long.
Air air_of(const State& state);

/// Optical depth between two places.
double depth_between(const Air& air, const Vec3& from_m, const Vec3& to_m);

/// The same for those who look for lamps `within_m`; empty where the air hides no lamp so near.
sight::OpticalDepth depth_for_lamps(const Air& air, double within_m);

/// True of a vehicle whose lamps are lit, or that burns.
bool shines(const State& state, const Participant& vehicle);

/// True where the driver's car, or another vehicle, has its dipped or main beams lit.
bool has_beams(const Participant& vehicle);

/// True within a tunnel, which is lit.
bool is_roofed(const road::RoadNetwork& network, const road::RoadPosition& place);

}  // namespace septet::simulation
