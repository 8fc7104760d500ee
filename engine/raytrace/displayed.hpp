#pragma once
/// Display image of a traced picture, by the rasteriser's exposure and tone curve.

#include "engine/image/image.hpp"
#include "engine/raytrace/ray_tracer.hpp"

namespace septet::raytrace {

/// Opaque; pixels not traced yet are black.
image::Image displayed(const TracedPicture& picture, const instant::Exposure& exposure);

}  // namespace septet::raytrace
