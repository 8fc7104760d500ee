#pragma once
/// The ledger of debris' energy: what the pieces store, what was given to them from outside, and what took it.
///
/// `advance_debris` keeps one where a caller hands it in, and works out nothing for it otherwise. Between two instants
///
///     stored now − stored then = given − lost        (`unexplained_j` is the difference of the two sides),
///
/// and it holds only as far as each account is right, for each is worked out by itself: what is stored by measuring the
/// state, the work of forces and contacts from their own impulses and the mean velocities of a step (step_energy.hpp),
/// flow from its stress and strain, cracks from their area. None is what the others leave. Where the debris rewrites a
/// state and moves nothing by a force (a bound takes energy out, a sleeper is stopped, a splinter becomes a shard), the
/// account is the difference of what the pieces that were rewritten stored before and after.
///
/// What it does not explain: cracks whose energy the pieces' deformation could not pay, and a crack of ice that grows
/// without opening, whose energy nothing pays yet.
///
/// What an impact loses is booked as pressing first. What flow, cracks and scatter are then paid from it moves to their
/// accounts, or back into the pieces.
///
/// All in joules, world frame (weight's work depends on no frame, but kinetic energy and the work of moving boxes do:
/// the ledger is that of who stands on the road). Potential energy is that of weight above z = 0.

#include "engine/effects/debris/debris_state.hpp"
#include "engine/effects/debris/piece.hpp"
#include "engine/physics/elastic/step_energy.hpp"

namespace septet::debris {

/// What a state stores at an instant.
struct StoredEnergy {
  double kinetic_j = 0.0;    ///< Of all nodes, and of the flight of shards: their spin is drawn and weighs nothing.
  double elastic_j = 0.0;    ///< Of stretch and shear since the natural shape, which holds all that has flowed.
  double potential_j = 0.0;  ///< Of weight. Gravity's work is what it has lost.
  double sum_j() const { return kinetic_j + elastic_j + potential_j; }
};
StoredEnergy stored_energy(const Piece& piece);
StoredEnergy stored_energy(const Shard& shard);
StoredEnergy stored_energy(const State& state);

struct EnergyLedger {
  // Given from outside; below zero where the pieces gave it away.
  double air_work_j = 0.0;  ///< Of the air's force on the nodes' ways.
  /// Of vehicles, wheels and all that moves: impulse times velocity of its surface. The press of two boxes on each other
  /// through a piece is in it, though Box::impulse_ns leaves that out: on the piece it works.
  double box_work_j = 0.0;

  // Lost; below zero it is energy that was made, or given back.
  /// In contacts with ground and boxes, along the normal, less what an impact has paid. What the soft gap of a contact
  /// stores is a loss until the contact gives it back: its stiffness is by the step, so that it keeps nothing for the next.
  double pressing_loss_j = 0.0;
  double friction_loss_j = 0.0;  ///< In contacts with ground and boxes, across the normal.
  double meeting_loss_j = 0.0;   ///< Between two pieces, along the normal.
  double rubbing_loss_j = 0.0;   ///< Between two pieces, across the normal.
  double plastic_loss_j = 0.0;   ///< By flow: stress times the strain that has moved into the natural shape.
  double fracture_loss_j = 0.0;  ///< In the surfaces of cracks: their area times the material's fracture energy.
  double viscous_loss_j = 0.0;  ///< By the material's damping β, and by the film of a pane that cracks (laminate.hpp).
  double numerical_loss_j = 0.0;   ///< By the implicit step; below zero where it makes energy.
  double bound_loss_j = 0.0;       ///< Taken out again by the bound of energy (energy_bound.hpp).
  double settling_loss_j = 0.0;    ///< Of pieces that were stopped to sleep, and of shards that were stopped.
  double stiffening_loss_j = 0.0;  ///< Spin and stretch of splinters that fly on as rigid shards.
  double melting_loss_j = 0.0;     ///< Gone with what melted.

  double given_j() const;
  double lost_j() const;
};

/// Energy that came or went without an account.
double unexplained_j(const StoredEnergy& before, const StoredEnergy& now, const EnergyLedger& ledger);

/// Energy that passed through: what the pieces moved and strained with at first, what their weight, the air and the
/// boxes gave in all. The scale of what may be unexplained.
double passed_j(const StoredEnergy& before, const StoredEnergy& now, const EnergyLedger& ledger);

/// Books what a step of a piece came to.
void book(EnergyLedger& ledger, const elastic::StepEnergy& step);

/// Does `act`, which rewrites a piece, and books what it stored before and does not store any more, if there is a ledger.
template <class Act>
void rewrite(EnergyLedger* ledger, double EnergyLedger::*loss_j, const Piece& piece, const Act& act) {
  const double before_j = ledger ? stored_energy(piece).sum_j() : 0.0;
  act();
  if (ledger) ledger->*loss_j += before_j - stored_energy(piece).sum_j();
}

}  // namespace septet::debris
