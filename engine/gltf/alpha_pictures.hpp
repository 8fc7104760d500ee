#pragma once
/// Alpha of a base colour's picture: what it cuts out, and whether it is seen through (glTF 2.0, 3.9.4).

#include "engine/image/image.hpp"

namespace septet::gltf {

/// Alpha below which a picture of a material is cut out here; a file has its own.
inline constexpr float cuts_below = 0.5f;

/// Moves the file's cutoff to that of here.
void move_cutoff(image::Image& picture, float cutoff);

/// True where more than a tenth of what is there is neither quite there nor quite gone: leaves with soft edges stay
/// cut out, which hides what is behind them in any order.
bool is_see_through(const image::Image& picture);

}  // namespace septet::gltf
