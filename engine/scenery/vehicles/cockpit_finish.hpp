#pragma once
/// What the inside of the driver's car is made of, and the faces of its instruments.

#include <cstdint>

#include "engine/scenery/palette.hpp"

namespace septet::scenery {

enum class CockpitFinish : std::uint32_t {
  paint,  ///< The bonnet's.
  soft,   ///< The top of the dashboard: dull, or it would be seen in the windscreen.
  panel,
  lining,
  leather,
  skin,
  cloth,
  gloss,
  metal,
  rubber,
  dial_faces,  ///< Lit from behind, as the signs.
  signs,
  water,  ///< Drops on the windscreen.
  carpet,
};

constexpr std::uint32_t index_of(CockpitFinish finish) { return static_cast<std::uint32_t>(finish); }

/// One material for each finish, in their order.
Palette add_cockpit_finishes(scene::SceneBuilder& builder);

}  // namespace septet::scenery
