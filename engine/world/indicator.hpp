#pragma once
/// Flashing of indicators: in the simulation, so that every screen agrees.

#include <cmath>

#include "engine/world/snapshot.hpp"

namespace septet {

/// True while an indicator that is switched on is lit: 0.37 s of every 0.7, 86 flashes a minute (UN R48: 90 ± 30).
inline bool indicator_is_lit(double time_s) {
  const double flashes = time_s * (1.0 / 0.7);
  return flashes - std::floor(flashes) < 0.37 / 0.7;
}

/// State of one vehicle's indicator among others, which flash out of phase.
inline bool indicator_is_lit(double time_s, ParticipantId vehicle) {
  return indicator_is_lit(time_s + 0.13 * static_cast<double>(vehicle % 7));
}

}  // namespace septet
