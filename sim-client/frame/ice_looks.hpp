#pragma once
/// Appearance of a drive's ice, lying, hanging or flying. Pure functions.

#include <span>
#include <vector>

#include "engine/instant/ice_body.hpp"

namespace septet::frame {

/// Look of pressed and refrozen snow: uneven, with a crust. `film`: amount of water on it, 0 to 1: it smooths the
/// surface and removes the crust.
ice::Look slab_look(float film);
/// Look of water that froze as it ran: clear, in rings.
ice::Look icicle_look(float film);
/// Look of frozen rain on a road: level, clear, with rime here and there.
ice::Look sheet_look(float film);

/// Cracks and air of the field within the bounding places at rest; `cell_m` is their approximate spacing.
std::vector<ice::IceVertex> cracks_between(std::span<const Vec3> rest_m, float cell_m);

/// Approximate size of the pieces between a slab's cracks.
inline constexpr float slab_crack_cell_m = 0.45f;

}  // namespace septet::frame
