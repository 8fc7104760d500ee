#pragma once
/// Pictures of house fronts in a town. sRGB.

#include <cstdint>
#include <string_view>

#include "engine/image/image.hpp"

namespace septet::scenery {

/// One storey of a plastered wall with its window, 4 m wide; tiles. Panes lie where those of facade_texture do.
image::Image plaster_facade_texture(std::uint64_t seed);

/// The same of brickwork.
image::Image brick_facade_texture(std::uint64_t seed);

/// Front of a shop as a whole: its name over the window, and the door.
image::Image shop_front_texture(std::string_view name, image::Color sign);

}  // namespace septet::scenery
