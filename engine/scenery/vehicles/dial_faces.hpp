#pragma once
/// Pictures of the instruments: the faces of both dials, and the signs that light up on them
/// (engine/world/instrument_panel.hpp).

#include "engine/image/image.hpp"

namespace septet::scenery {

image::Image dial_faces_image();
image::Image signs_image();

}  // namespace septet::scenery
