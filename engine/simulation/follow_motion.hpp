#pragma once
/// The driver's car along a given motion (given_motion.hpp), as a part of its stage.

#include "engine/simulation/state.hpp"

namespace septet::simulation {

/// Puts the car at the beginning of its table, if it has one, with its velocity.
void begin_motion(const Model& model, State& state);

/// Leads the car along its table, after its own step, until that ends or the car has touched something; `has_touched`:
/// in this step. `before_mps`: its velocity in plan before the step.
void follow_motion(const Model& model, bool has_touched, const Vec2& before_mps, State& state);

}  // namespace septet::simulation
