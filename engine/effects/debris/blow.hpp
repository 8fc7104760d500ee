#pragma once
/// An impact: a contact that is over before the step is.
///
/// A stiff piece that meets another stiff body at speed V is stopped within the time that a wave needs to its far side
/// and back, τ = 2L/c with c = √(Y/ρ): 50 µs for a slab of ice, 10 to 100 times less than a step. The step carries the
/// right impulse (1+e)mV, but as if it had been spread over Δt, and so the stress that its multiplier shows is too
/// small. `stress_factor` Δt c/((1+e)L) makes a plane impact's stress ρcV, that of the wave, at the struck surface; an
/// element of length h there has only the share 1 − h/2L of it, by which the factor is divided.
///
/// Of the energy with which contact points closed, e² is returned as rebound (Newton's coefficient of restitution). The
/// lost energy pays once: for plastic flow and what that stores, then for the surfaces of cracks, and a share of the rest
/// for the scatter of the fragments.

#include <span>

#include <Eigen/Core>

#include "engine/effects/debris/contacts.hpp"
#include "engine/effects/debris/debris_state.hpp"
#include "engine/effects/debris/piece.hpp"

namespace septet::debris {

struct Blow {
  Eigen::Vector3d normal{0.0, 0.0, 1.0};  ///< Mean direction of the impulse on the piece.
  double stress_factor = 1.0;             ///< Factor of ElasticBody::step_stress_pa.
  double lost_j = 0.0;                    ///< Taken by the contact.
  double pressed_j = 0.0;                 ///< Work of lasting pressure: pays for cracks, scatters nothing.
};

/// Closing speed below which a contact is pressure and no impact, and returns no energy.
inline constexpr double least_blow_speed_mps = 1.0;

/// Share of the lost energy, less that of the cracks, for the fragments' scatter. Estimate.
inline constexpr double scatter_share = 0.2;

/// Makes fast closing contacts return `restitution` of their speed, for one step of `step_s`. Returns each contact's
/// closing speed, 0 where it is no impact.
std::vector<double> add_restitution(const Piece& piece, std::vector<FoundContact>& contacts, double step_s);

/// Impact of a step's contacts, from their impulses and closing speeds.
Blow blow_of(const Piece& piece, std::span<const elastic::NodeContact> contacts, std::span<const double> closing_mps,
             double step_s);

/// Scatters fragments across the impact's normal with an additional `energy_j`. Momentum and angular momentum of all
/// together stay. Returns the energy that they got: 0 where they cannot part.
double scatter(std::vector<Piece>& fragments, const Eigen::Vector3d& normal, double energy_j);

}  // namespace septet::debris
