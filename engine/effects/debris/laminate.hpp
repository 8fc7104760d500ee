#pragma once
/// Laminated panes: two of glass with a film of polyvinyl butyral (PVB) between them. Glass that breaks stays on the
/// film: cracks run, and no face opens. What then holds the pane together, and hangs, is the film.

#include "engine/effects/debris/fracture.hpp"
#include "engine/effects/debris/piece.hpp"

namespace septet::debris {

/// Reach of a crack that has parted the glass of a face; its film holds.
inline constexpr double cracked_through = 0.996;

/// Stiffness of a cracked pane over a whole one's: 0.76 mm of PVB in a pane of 4.4 mm, 40 MPa to the glass's 70 GPa.
/// The film's thickness is that of makers' tables; its modulus, assumed, lies between that of a short and a long load.
inline constexpr double film_share = 1e-4;

/// Material of a piece's lattice as it is: of a cracked pane that of its film.
elastic::ElasticMaterial present_elastic(const Piece& piece);

/// Gives a piece the cracks of a fracture in which no face opened; a laminated one that they are the first of goes
/// limp. Returns the energy that its shape has lost.
double take_cracks(Piece& piece, FractureResult& result);

}  // namespace septet::debris
