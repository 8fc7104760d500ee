#pragma once
/// A traced picture as a display shows it: by the same exposure and tone curve as the rasteriser's.

#include "engine/image/image.hpp"
#include "engine/raytrace/ray_tracer.hpp"

namespace septet::raytrace {

/// Opaque; what is not traced yet is black.
image::Image displayed(const TracedPicture& picture, const instant::Exposure& exposure);

}  // namespace septet::raytrace
