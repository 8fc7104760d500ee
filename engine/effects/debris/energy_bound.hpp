#pragma once
/// The energy that a step may leave a piece with. The elastic step errs where elements turn or shear by much within it,
/// and where surfaces demand what no velocity satisfies; what has no source is taken out again.

#include <span>
#include <vector>

#include <Eigen/Core>

#include "engine/effects/debris/contacts.hpp"
#include "engine/effects/debris/piece.hpp"
#include "engine/physics/elastic/step.hpp"

namespace septet::debris {

/// The surfaces that enclose a piece, and the energy that they may leave it with, in the frame that moves with their
/// middle. One surface, whatever its speed, returns less than it took: in its own frame a piece gains no energy. Two
/// that close on a piece can make it as fast as they are themselves: they are vehicles, whose metal yields before it
/// does more.
struct Frame {
  Eigen::Vector3d velocity_mps{0, 0, 0};
  double allowed_j = 0.0;  ///< Kinetic, in the frame, and elastic.
};

/// Of a piece before its step.
Frame frame_of(const Piece& piece, std::span<const FoundContact> found, double step_s);

/// Takes energy beyond the frame's out of the deformation: of its velocity, and of its shape by relaxing towards the
/// natural one, which holds what has flowed. Mass, momentum and angular momentum stay; energy never grows.
void bound_energy(Piece& piece, const Frame& frame);

/// Takes energy out of the deformation of pieces, in proportion to what each has, as far as they have so much.
void take_from_deformation(std::vector<Piece>& pieces, double energy_j);

/// Where surfaces made the piece faster than the frame allows, the step's change of velocity, and with it the surfaces'
/// impulses, is taken only as far as that. `position_m` and `velocity_mps` are those before the step. Returns the share
/// that was taken.
double bound_blow(Piece& piece, const Frame& frame, double step_s, std::span<const Eigen::Vector3d> position_m,
                  std::span<const Eigen::Vector3d> velocity_mps, std::vector<elastic::NodeContact>& contacts);

/// Energy lost in the surfaces' frame: it pays for flow, cracks and scatter.
double lost_j(const Piece& piece, const Frame& frame);

}  // namespace septet::debris
