#include "engine/physics/elastic/bounded_step.hpp"

#include "engine/physics/elastic/body_measures.hpp"

namespace septet::elastic {
namespace {

constexpr double tolerated_growth = 1e-3;

double energy_j(const ElasticBody& body) { return kinetic_energy_j(body) + elastic_energy_j(body); }

}  // namespace

BoundedStepReport step_within_energy(ElasticBody& body, const StepSettings& settings, int most_halvings) {
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
