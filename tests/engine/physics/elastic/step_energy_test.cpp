/// The accounts of a step's energy are what the body gained and lost.

#include "engine/physics/elastic/step_energy.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>
#include <Eigen/Geometry>

#include "engine/math/gravity.hpp"
#include "engine/physics/elastic/body_measures.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::elastic;

namespace {

constexpr double energy_tick_s = 1.0 / 60.0;

ElasticBody block(double young_modulus_pa, double poisson_ratio = 0.3) {
  return *make_elastic_body(lattice_mesh({2, 2, 2}, {0.2, 0.3, 0.2}), {young_modulus_pa, poisson_ratio, 1000.0});
}

double stored_j(const ElasticBody& body) {
  double sum_j = kinetic_energy_j(body) + elastic_energy_j(body);
  for (int i = 0; i < body.node_count(); ++i) sum_j += body.mass_kg[i] * gravity_mps2 * body.position_m[i].z();
  return sum_j;
}

double given_j(const StepEnergy& e) { return e.force_work_j + e.surface_work_j; }
double lost_j(const StepEnergy& e) {
  return e.pressing_loss_j + e.friction_loss_j + e.viscous_loss_j + e.numerical_loss_j;
}

struct Steps {
  double worst_j = 0.0;  ///< Greatest energy of a step that no account has.
  double passed_j = 0.0;
  double surface_work_j = 0.0;
  int under_tension = 0, inverted = 0;
};

/// Thirty steps against what `contacts_of` finds.
template <class Contacts>
Steps steps_of(ElasticBody body, const Contacts& contacts_of) {
  StepSettings settings;
  settings.step_s = energy_tick_s;
  Steps steps;
  for (int k = 0; k < 30; ++k) {
    const ElasticBody before = body;
    std::vector<NodeContact> contacts = contacts_of(body);
    const StepReport report = step_elastic(body, settings, contacts);
    steps.under_tension += report.under_tension;
    steps.inverted += report.inverted;
    const StepEnergy energy = step_energy(before, body, settings, contacts);
    steps.surface_work_j += energy.surface_work_j;
    steps.passed_j = std::max({steps.passed_j, kinetic_energy_j(body), elastic_energy_j(body), kinetic_energy_j(before),
                               elastic_energy_j(before)});
    steps.worst_j =
        std::max(steps.worst_j, std::abs(stored_j(body) - stored_j(before) - given_j(energy) + lost_j(energy)));
  }
  return steps;
}

std::vector<NodeContact> no_contacts(const ElasticBody&) { return {}; }

/// A belt at z = 0 that runs along x.
std::vector<NodeContact> belt(const ElasticBody& body) {
  std::vector<NodeContact> contacts;
  for (int i = 0; i < body.node_count(); ++i)
    if (body.position_m[i].z() < 0.05)
      contacts.push_back(
          {.node = i, .gap_m = body.position_m[i].z(), .surface_velocity_mps = {2.0, 0.0, 0.0}, .friction = 0.5});
  return contacts;
}

}  // namespace

TEST_CASE("the accounts of a step sum to what the body gained") {
  const auto closes = [](const Steps& steps) {
    CHECK(steps.passed_j > 0.1);
    CHECK(steps.worst_j < 1e-8 * steps.passed_j);
  };
  ElasticBody turning = block(1e7);
  for (int i = 0; i < turning.node_count(); ++i) {
    turning.velocity_mps[i] = Eigen::Vector3d(1.0, 4.0, 2.0).cross(turning.position_m[i]);
    turning.force_n[i] = {0.3, 0.1, 0.0};
  }
  closes(steps_of(turning, no_contacts));

  ElasticBody carried = block(1e6);
  for (auto& v : carried.velocity_mps) v = {0.0, 0.0, -2.0};
  const Steps on_belt = steps_of(carried, belt);
  closes(on_belt);
  CHECK(on_belt.surface_work_j > 0.0);

  ElasticBody incompressible = block(1e6, 0.5);
  for (auto& v : incompressible.velocity_mps) v = {0.0, 0.0, -2.0};
  closes(steps_of(incompressible, belt));

  ElasticBody dragged = block(1e6);
  for (int i = 0; i < dragged.node_count(); ++i) {
    if (dragged.rest_position_m[i].x() > 0.01) continue;
    dragged.fixed[i] = 1;
    dragged.velocity_mps[i] = {-1.0, 0.0, 3.0 * dragged.rest_position_m[i].y()};  // It cannot turn as a whole.
  }
  closes(steps_of(dragged, no_contacts));

  ElasticBody drawn = block(1e8);
  for (auto& x : drawn.position_m) x.x() *= 1.5;
  const Steps pulled = steps_of(drawn, no_contacts);
  closes(pulled);
  CHECK(pulled.under_tension > 0);

  ElasticBody turned_out = block(1e5);
  for (auto& x : turned_out.position_m) x.z() *= -0.2;
  const Steps flat = steps_of(turned_out, no_contacts);
  closes(flat);
  CHECK(flat.inverted > 0);
}

TEST_CASE("a step's share that is taken is what is booked") {
  ElasticBody body = block(1e6);
  for (auto& x : body.position_m) x.z() *= 0.9;
  const ElasticBody before = body;
  StepSettings settings;
  settings.step_s = energy_tick_s;
  step_elastic(body, settings);
  constexpr double share = 0.3;
  for (int i = 0; i < body.node_count(); ++i) {
    body.velocity_mps[i] *= share;  // It began at rest.
    body.position_m[i] = before.position_m[i] + energy_tick_s * body.velocity_mps[i];
  }
  const StepEnergy energy = step_energy(before, body, settings, {}, share);
  const double gained_j = stored_j(body) - stored_j(before);
  CHECK(std::abs(gained_j - given_j(energy) + lost_j(energy)) < 1e-9 * elastic_energy_j(before));
}

TEST_CASE("a fall loses to its step what weight does in half of it and a spin loses nothing") {
  ElasticBody body = block(1e9);
  for (int i = 0; i < body.node_count(); ++i)
    body.velocity_mps[i] = Eigen::Vector3d(0.0, 0.0, 2.0).cross(body.position_m[i] - centre_of_mass_m(body));
  StepSettings settings;
  settings.step_s = energy_tick_s;
  const ElasticBody before = body;
  step_elastic(body, settings);
  const double gained_mps = energy_tick_s * gravity_mps2;
  const StepEnergy energy = step_energy(before, body, settings, {});
  CHECK(energy.numerical_loss_j == relative(0.5 * total_mass_kg(body) * gained_mps * gained_mps, 0.02));
  CHECK(std::abs(energy.viscous_loss_j) < 1e-3 * kinetic_energy_j(before));
}

TEST_CASE("a stretch that is let go loses viscously what beta times its rate takes") {
  // A bar that swings along itself at frequency ω loses β ω² of its kinetic energy a second, twice over.
  ElasticBody bar = *make_elastic_body(lattice_mesh({8, 1, 1}, {4.0, 0.2, 0.2}), {1e6, 0.0, 1000.0});
  for (auto& x : bar.position_m) x.x() -= 0.01 * std::cos(std::numbers::pi * x.x() / 4.0);
  StepSettings settings;
  settings.step_s = 1e-4;
  settings.gravity_mps2.setZero();
  const double stored = elastic_energy_j(bar);
  double viscous_j = 0.0, numerical_j = 0.0;
  const double period_s = 2.0 * 4.0 / std::sqrt(1e6 / 1000.0);
  const int count = static_cast<int>(period_s / settings.step_s);
  for (int k = 0; k < count; ++k) {
    const ElasticBody before = bar;
    step_elastic(bar, settings);
    const StepEnergy energy = step_energy(before, bar, settings, {});
    viscous_j += energy.viscous_loss_j;
    numerical_j += energy.numerical_loss_j;
  }
  const double rate_radps = 2.0 * std::numbers::pi / period_s, beta_s = settings.damping_ratio * settings.step_s;
  CHECK(viscous_j == relative(beta_s * rate_radps * rate_radps * stored * period_s, 0.1));
  CHECK(std::abs(numerical_j) < 0.01 * stored);
}
