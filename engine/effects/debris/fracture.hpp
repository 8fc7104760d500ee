#pragma once
/// Fracture and plastic flow.
///
/// Fracture follows O'Brien and Hodgins 1999 in the real-time form of Parker and O'Brien 2009: the tetrahedra are
/// grouped into splinters beforehand, and a face between two splinters opens where the greatest principal stress passes
/// the material's strength and pulls across it. Nothing is remeshed; nodes are doubled. Every tetrahedron keeps its
/// mass and every copy of a node its place and velocity, so mass, momentum and angular momentum are those of before,
/// exactly.
///
/// Under an impact the stress is that of its peak (blow.hpp). Pressure then opens the faces along it, as axial
/// splitting does, beyond the compressive strength or, in brittle materials, where the sides bulge by more than the
/// strength allows (f_t/ν): within a wave's time they are free. Faces that only the impact opens cost their fracture
/// energy, the most overloaded first, until the energy lost in the impact is used up; a share of the rest scatters the
/// fragments. A face that a lasting pull opens takes its fracture energy from the deformation of the pieces
/// (energy_bound.hpp). A brittle sheet, one cube thick, cracks as well where its surfaces are bent beyond the strength,
/// and straight through (sheet_crack.hpp).
///
/// In ice a face cracks before it opens. Under a lasting pull σ a crack of reach a grows as damage does after Kachanov
/// (1958), in which the rest of a section carries all of its load: ȧ = (σ/((1 − a) f_t))ⁿ/τ, so that after t of a
/// constant pull (1 − a)ⁿ⁺¹ = 1 − t/t_r with t_r = τ/(n + 1) (f_t/σ)ⁿ, and the face opens when σ passes the strength of
/// the rest, at a = 1 − σ/f_t. In an impact, the face that its energy no longer pays for in full cracks as far as it
/// reaches; the next impact has only the rest to pay.
///
/// Plastic flow is multiplicative: F = Fe·Fp, and the strain beyond the yield stress moves from Fe to Fp. A part that
/// bends as a sheet flows by its section (sheet_flow.hpp).

#include <vector>

#include "engine/effects/debris/blow.hpp"
#include "engine/effects/debris/debris_state.hpp"
#include "engine/effects/debris/piece.hpp"

namespace septet::debris {

struct FractureResult {
  int opened_faces = 0;
  std::vector<Piece> pieces;      ///< Pieces after the fracture; empty where no face opened.
  std::vector<FaceCrack> cracks;  ///< Cracks of the piece where no face opened.
  double cracked_j = 0.0;         ///< Area that has parted times the material's fracture energy.
  double paid_j = 0.0;            ///< As much of it as an impact's lost energy has paid.
  double scattered_j = 0.0;       ///< Energy that the scatter gave the pieces.
};

/// n and τ. Both assumed: published exponents of ice's damage are from 3 to 5; a pull of 0.9 f_t parts it within half a
/// second.
inline constexpr double crack_exponent = 4.0, crack_time_s = 3.3;
/// Share of the strength below which no crack grows.
inline constexpr double least_cracking_share = 0.4;

/// Opens the overloaded faces and lets cracks grow for `step_s`. The pieces' ids are zero.
FractureResult fracture(const Piece& piece, const Blow& blow = {}, double step_s = 0.0);

/// What flow came to.
struct Flow {
  int elements = 0;        ///< That have flowed.
  double plastic_j = 0.0;  ///< Work of flow: stress times strain.
  double paid_j = 0.0;     ///< Taken from an impact's lost energy, for work and for what its strain stores.
};

/// Lets the overloaded elements flow. Elements overloaded by an impact flow as far as its lost energy reaches.
Flow flow(Piece& piece, const Blow& blow = {});

/// The strain that an impact's lost energy pays: the stress of flow times it over the overloaded elements. The shape
/// takes the strain as well, for the stress has come and gone within the step; what this stores, and gives back later, is
/// paid too: μ s² + σ s = energy a volume.
double strain_paid_by(double energy_j, double flow_stress_pa, double mu_pa, double volume_m3);

/// Most that flows under one blow.
inline constexpr double most_strain_of_blow = 0.1;

}  // namespace septet::debris
