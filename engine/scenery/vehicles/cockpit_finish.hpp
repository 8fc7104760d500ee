#pragma once
/// Materials of the inside of the driver's car, and the faces of its instruments.

#include <cstdint>

#include "engine/scenery/palette.hpp"

namespace septet::scenery {

enum class CockpitFinish : std::uint32_t {
  paint,  ///< Paint of the bonnet.
  soft,   ///< Top of the dashboard: dull, or the windscreen would mirror it.
  panel,
  lining,
  leather,
  skin,
  cloth,
  gloss,
  metal,
  rubber,
  dial_faces,  ///< Backlit, as are the signs.
  signs,
  water,  ///< Drops on the windscreen.
  carpet,
};

constexpr std::uint32_t index_of(CockpitFinish finish) { return static_cast<std::uint32_t>(finish); }

/// One material for each finish, in their order.
Palette add_cockpit_finishes(scene::SceneBuilder& builder);

}  // namespace septet::scenery
