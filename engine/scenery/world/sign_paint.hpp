#pragma once
/// Traffic signs as pictures and outlines. Symbols are drawn with our own strokes: distinguishable at a distance, not
/// copied from any table.

#include <vector>

#include <glm/vec2.hpp>

#include "engine/image/image.hpp"
#include "engine/scenery/world/sign_catalogue.hpp"

namespace septet::scenery {

/// Picture of a sign, 96 × 96, sRGB; the area outside the outline is not drawn.
image::Image paint_sign(const SignFace& face);

/// Corners in the picture, x to the right and y down in 0 … 1, clockwise as it is read.
std::vector<glm::vec2> sign_outline(SignStyle style);

}  // namespace septet::scenery
