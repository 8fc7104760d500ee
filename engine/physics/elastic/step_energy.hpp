#pragma once
/// Where the energy of one elastic step came from and went to, account by account.
///
/// A step changes velocities from v₀ to v₁ by impulses I, so kinetic energy changes by Σ I·v̄ with v̄ = ½ (v₀ + v₁),
/// exactly. Each account is the work of its own impulses with v̄, worked out again from the state before the step; no
/// account is what the others leave. So they sum to the change of kinetic, elastic and potential energy as far as the
/// step solved its own equations, and that is what a ledger of them proves.
///
/// All in joules, world frame. Works are positive where they add to the body, losses where they take from it; a loss
/// below zero is energy that the step made.

#include <span>
#include <vector>

#include "engine/physics/elastic/elastic_body.hpp"
#include "engine/physics/elastic/step.hpp"

namespace septet::elastic {

struct StepEnergy {
  double force_work_j = 0.0;    ///< Of ElasticBody::force_n, along the nodes' ways.
  double surface_work_j = 0.0;  ///< Of moving surfaces and of moving fixed nodes: their impulses times their velocity.
  /// Taken by contacts along their normals, seen from the surface: lost in an impact, or lent to the soft gap, which
  /// gives it back when the node leaves.
  double pressing_loss_j = 0.0;
  double friction_loss_j = 0.0;  ///< Taken by contacts across their normals, seen from the surface.
  double viscous_loss_j = 0.0;   ///< By the strain's rate times β, the damping that StepSettings asks for.
  /// By the integrator: what stresses and forces did at the step's mean velocity, beside what they did along its ways.
  /// Below zero where elements turn or shear by much within a step.
  double numerical_loss_j = 0.0;
};

/// Of a step of these settings that led from `before` to `after`, whose workspace still has its solution. The contacts
/// have the impulses that the step gave and the surfaces' own velocities. `share`: that of the step's change of velocity
/// which was taken, 1 where nothing cut it down.
StepEnergy step_energy(ElasticBody before, const ElasticBody& after, const StepSettings& settings,
                       std::span<const NodeContact> contacts, double share = 1.0);

}  // namespace septet::elastic
