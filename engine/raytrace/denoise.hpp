#pragma once
/// Noise out of a traced picture, after it is whole: each pixel becomes a mean of those around it that are like it.
///
/// Alike are pixels whose surroundings of 3 × 3 differ by no more than their variances explain, as Rousselle, Knaus and Zwicker weigh them in
/// "Adaptive Rendering with Non-Local Means Filtering" (2012), and whose first surfaces have the same normal and about the same albedo.
/// Light is divided by the albedo before and multiplied after, so that what is painted on a surface stays sharp. Where there is no
/// variance nothing changes. Sparks, of which few samples know by chance, are first made as bright as what is around them, so a picture of few samples
/// loses some of the light that only such chances bring. What is seen in mirrors and through glass has no guide but its own light.
///
/// A picture's pixels depend on the picture alone; it runs on this machine's cores.

#include "engine/raytrace/ray_tracer.hpp"

namespace septet::raytrace {

/// The same picture with other radiance; all else, the variance too, is that of the samples. They are two a pixel or more.
TracedPicture denoised(const TracedPicture& picture, const instant::Exposure& exposure);

}  // namespace septet::raytrace
