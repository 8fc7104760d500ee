#pragma once
/// How far a motion leads.

#include "engine/scene/motion.hpp"

namespace septet::scene {

/// Largest coordinate in m, without its sign, on the way from the beginning to the last leg, which goes on for ever. The
/// motion's numbers are finite.
double farthest_coordinate_m(const Motion& motion);

}  // namespace septet::scene
