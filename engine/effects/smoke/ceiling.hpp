#pragma once
/// Warm smoke under the roof of a tube: a current that spreads both ways from its fires.
///
/// The layer is what its particles make it. In a slice across the tube their warmth is E joules a metre of length; over
/// the tube's width W it is S = g·E/(ρ·c·T·W), which is g′h of a layer, with ρ·c·T = 3.5 times the air's pressure. The
/// layer's depth h follows from the mean height of the warmth. It runs at Fr·√(S·(1 − h/H)) through the air, H the
/// tube's height (the last factor is the part of the head that an even mixture lacks), away from the fires; the air below
/// comes back and fills its place. A draught moves both. So the cube root of the power, the standstill of the layer
/// against a draught and its end with the fire are results, not rules. docs/smoke.md has the figures beside those
/// published.

#include <vector>

#include "engine/effects/smoke/velocity_field.hpp"

namespace septet::smoke {

struct Grid;

/// Floor, roof and width of each slice of cells across x.
std::vector<TubeSlice> tube_slices(const Grid& grid);

/// Fills VelocityField::current from State::warmth; still air where nothing is warm or there is no roof.
void update_ceiling_current(const State& state, VelocityField& field);

}  // namespace septet::smoke
