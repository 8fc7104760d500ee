#pragma once
/// Breaking and bending for good.
///
/// Fracture follows O'Brien and Hodgins 1999 in the real-time form of Parker and O'Brien 2009: the
/// tetrahedra are grouped into splinters beforehand, and a face between two splinters opens where
/// the greatest principal stress passes the material's strength and pulls across it. Nothing is
/// remeshed; nodes are doubled. Every tetrahedron keeps its mass and every copy of a node its place
/// and velocity, so mass, momentum and angular momentum are those of before, exactly.
///
/// Under a blow the stress is that of its peak (blow.hpp). Pressure then opens the faces
/// along it, as axial splitting does, beyond the compressive strength or, in brittle materials,
/// where the sides bulge by more than the strength allows (f_t/ν): within a wave's time they are
/// free. Faces that only the blow opens cost their fracture energy, the most overloaded first,
/// until what the blow lost is used up; a share of the rest scatters the fragments.
///
/// Plastic flow is multiplicative: F = Fe·Fp, and what passes the yield stress moves from Fe to Fp.

#include <vector>

#include "engine/effects/debris/blow.hpp"
#include "engine/effects/debris/debris_state.hpp"
#include "engine/effects/debris/piece.hpp"

namespace septet::debris {

struct FractureResult {
  int opened_faces = 0;
  std::vector<Piece> pieces;  ///< What the piece is now; empty where nothing opened.
};

/// Opens the overloaded faces. The pieces' ids are zero.
FractureResult fracture(const Piece& piece, const Blow& blow = {});

/// Lets the overloaded elements flow; returns how many did. What a blow overloads flows as far as
/// the energy that it lost reaches.
int flow(Piece& piece, const Blow& blow = {});

}  // namespace septet::debris
