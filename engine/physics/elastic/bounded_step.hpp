#pragma once
/// A step that adds no energy of its own.
///
/// step_elastic moves nodes along straight lines. Where elements turn within a step by an angle θ, that stretches them
/// by θ²/2 and creates the energy of the stretch: a clamped beam of 100 MPa let go from a twist of a radian turns by a
/// third of a radian in 15 ms and comes to a multiple of its energy. The error falls with the square of the step, so a
/// step whose energy grew by more than the forces' work is undone and repeated as two halves.
///
/// For bodies under gravity and constant forces whose fixed nodes stand still. Contacts do work that is not known here;
/// debris bounds its energy itself (advance_debris.cpp).

#include "engine/physics/elastic/elastic_body.hpp"
#include "engine/physics/elastic/step.hpp"

namespace septet::elastic {

struct BoundedStepReport {
  int steps = 0;        ///< Steps made, undone ones included.
  bool bounded = true;  ///< False: even the shortest step gained more.
  int bad_numbers = 0;
};

/// Advances by settings.step_s in up to 2^`most_halvings` steps. In each, kinetic and elastic energy grow by no more
/// than the work of gravity and forces and a thousandth of themselves. β/Δt is kept.
BoundedStepReport step_within_energy(ElasticBody& body, const StepSettings& settings, int most_halvings = 6);

}  // namespace septet::elastic
