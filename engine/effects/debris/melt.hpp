#pragma once
/// Melting of pieces of ice, by the law of heat of the ice at rest (`engine/effects/ice/still_ice.hpp`): a part thins
/// from its outer side by the thickness that a surface loses, k ∫ max(0, T − 273.15 K) dt. All pieces of a part thin
/// along its z axis by the same share, whichever way they lie, so that each loses the law's mass over its upper area.
/// Edges keep their place: a few millimetres beside decimetres.

#include "engine/effects/debris/debris_state.hpp"

namespace septet::debris {

/// Share of a part's whole height below which what is left runs off as water. Chosen.
inline constexpr double least_height_left = 0.1;

/// Melts all pieces of ice by `melted_m`, metres of thickness; other materials stay as they are. Velocities stay, and
/// the lost mass takes its share of momentum and energy along; neither grows. A piece sinks with its thickness and
/// stays on what it lies on; a sleeper wakes at every millimetre, so that it settles and screens are told. Removes
/// what has run off.
void melt_ice(State& state, double melted_m);

}  // namespace septet::debris
