#pragma once
/// Finishes of vehicles: the materials of paint, glass, rubber and lamps.

#include <cstdint>

#include "engine/scenery/palette.hpp"

namespace septet::scenery {

enum class Finish : std::uint32_t {
  paint,
  glass,
  trim,
  underbody,
  tyre,
  rim,
  chrome,
  plate,
  cabin,
  white_panel,
  livery_yellow,
  livery_blue,
  chequers,
  lettering,
  lettering_mirrored,
  lens_head,
  lens_tail,
  lens_brake,
  lens_reverse,
  lens_indicator,
  lens_beacon,
  skin,
  cloth_dark,
  cloth_bright,
  leather,
  tarpaulin,
  fire_red,
  police_lettering,
  taxi_sign,
  timber,
  clear_glass,  ///< Tinted and transparent.
  mirror,       ///< Silvered glass.
  cloth,        ///< Of the participant's own colour.
  hair,
  lining,     ///< Of a cabin, seen from within.
  dashboard,  ///< Likewise.
};

constexpr std::uint32_t index_of(Finish finish) { return static_cast<std::uint32_t>(finish); }

/// One material for each finish, in their order, with the bitmaps of number plate and livery.
Palette add_finishes(scene::SceneBuilder& builder);

}  // namespace septet::scenery
