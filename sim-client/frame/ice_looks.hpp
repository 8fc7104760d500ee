#pragma once
/// How the ice of a drive looks, whether it lies, hangs or flies. Pure functions.

#include <span>
#include <vector>

#include "engine/instant/ice_body.hpp"

namespace septet::frame {

/// `film`: how much water stands on it, 0 to 1: it smooths the surface and takes the crust away.
/// Snow that was pressed and has frozen: uneven, with a crust.
ice::Look slab_look(float film);
/// Water that froze as it ran: clear, in rings.
ice::Look icicle_look(float film);
/// Frozen rain on a road: level, clear, with rime here and there.
ice::Look sheet_look(float film);

/// Cracks and air of the field that reach into what lies between these places at rest; `cell_m` is how far they stand apart,
/// about.
std::vector<ice::IceVertex> cracks_between(std::span<const Vec3> rest_m, float cell_m);

/// How large the pieces between the cracks of a slab are, about.
inline constexpr float slab_crack_cell_m = 0.45f;

}  // namespace septet::frame
