#pragma once
/// A step that adds no energy of its own.
///
/// step_elastic moves nodes along straight lines. Where elements turn within a step by an angle θ, that stretches them
/// by θ²/2 and creates the energy of the stretch: a clamped beam of 100 MPa let go from a twist of a radian turns by a
/// third of a radian in 15 ms and comes to a multiple of its energy. The error falls with the square of the step, so a
/// step whose energy grew by more than the forces' work is undone and repeated as two halves.
///
/// For bodies under gravity and constant forces whose fixed nodes stand still. Contacts do work that is not known here;
/// debris bounds its energy itself (energy_bound.hpp).

#include "engine/physics/elastic/body_measures.hpp"
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
inline BoundedStepReport step_within_energy(ElasticBody& body, const StepSettings& settings, int most_halvings = 6) {
  constexpr double tolerated_growth = 1e-3;
  const auto energy_j = [](const ElasticBody& of) { return kinetic_energy_j(of) + elastic_energy_j(of); };
  const auto position_m = body.position_m, velocity_mps = body.velocity_mps;
  const auto rotation = body.rotation;
  const double before_j = energy_j(body);
  const StepReport step = step_elastic(body, settings);
  double work_j = 0.0;
  for (int i = 0; i < body.node_count(); ++i)
    work_j += (body.mass_kg[i] * settings.gravity_mps2 + body.force_n[i]).dot(body.position_m[i] - position_m[i]);
  if (energy_j(body) <= before_j + work_j + tolerated_growth * before_j) return {1, true, step.bad_numbers};
  if (most_halvings == 0) return {1, false, step.bad_numbers};
  body.position_m = position_m;
  body.velocity_mps = velocity_mps;
  body.rotation = rotation;
  StepSettings half = settings;
  half.step_s *= 0.5;
  BoundedStepReport report{1, true, 0};
  for (int k = 0; k < 2; ++k) {
    const BoundedStepReport part = step_within_energy(body, half, most_halvings - 1);
    report.steps += part.steps;
    report.bounded = report.bounded && part.bounded;
    report.bad_numbers += part.bad_numbers;
  }
  return report;
}

}  // namespace septet::elastic
