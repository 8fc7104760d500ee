#pragma once
/// Denoising of a complete traced picture: each pixel becomes a mean of similar pixels around it.
///
/// Similar are pixels whose surroundings of 3 × 3 differ by no more than their variances explain, weighed as in
/// Rousselle, Knaus and Zwicker, "Adaptive Rendering with Non-Local Means Filtering" (2012), and whose first surfaces
/// have the same normal and about the same albedo. Light is divided by the albedo before and multiplied after, so that
/// textures stay sharp. Pixels without variance do not change. Sparks, which few samples have met by chance, are first
/// dimmed to the brightness around them, so that a picture of few samples loses some of the light that only such
/// chances bring. Reflections and views through glass have no guide but their own light.
///
/// Each pixel of the result depends on the picture alone. Work is spread over this machine's cores.

#include "engine/raytrace/ray_tracer.hpp"

namespace septet::raytrace {

/// Same picture with filtered radiance; all other layers, the variance too, stay those of the samples. Needs two
/// samples a pixel or more.
TracedPicture denoised(const TracedPicture& picture, const instant::Exposure& exposure);

}  // namespace septet::raytrace
