#pragma once
/// Plastic flow of a piece of sheet (engine/physics/elastic/shell.hpp): where its section flows through, and under a blow
/// as far as the energy lost in it reaches.

#include "engine/effects/debris/fracture.hpp"

namespace septet::debris {

/// As `flow`, of a piece whose body has a shell. The wave of a blow stretches the sheet along itself and bends nothing.
Flow flow_sheet(Piece& piece, const Blow& blow);

}  // namespace septet::debris
