#pragma once
/// Breaking and bending for good.
///
/// Fracture follows O'Brien and Hodgins 1999 in the real-time form of Parker and O'Brien 2009: the
/// tetrahedra are grouped into splinters beforehand, and a face between two splinters opens where
/// the greatest principal stress passes the material's strength and pulls across it. Nothing is
/// remeshed; nodes are doubled. Every tetrahedron keeps its mass and every copy of a node its place
/// and velocity, so mass, momentum and angular momentum are those of before, exactly.
///
/// Plastic flow is multiplicative: F = Fe·Fp, and what passes the yield stress moves from Fe to Fp.

#include <vector>

#include "engine/effects/debris/debris_state.hpp"

namespace septet::debris {

struct FractureResult {
  int opened_faces = 0;
  std::vector<Piece> pieces;  ///< What the piece is now; empty where nothing opened.
};

/// Opens the overloaded faces. The pieces' ids are zero.
FractureResult fracture(const Piece& piece);

/// Lets the overloaded elements flow; answers how many did.
int flow(Piece& piece);

}  // namespace septet::debris
