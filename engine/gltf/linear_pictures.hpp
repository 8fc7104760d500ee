#pragma once
/// Pictures of numbers, not colours: roughness, metallic and occlusion in one, and normals.

#include "engine/image/image.hpp"

namespace septet::gltf {

/// Red: of `dark` its red, as strong as that; green and blue: of `rough` (3.9.2, 3.9.3). One may be null: white. As
/// large as the larger.
image::Image properties_of(const image::Image* rough, const image::Image* dark, float strength);

/// Normals whose lean along both axes of the picture is scaled (3.9.3).
void scale_normals(image::Image& normals, float scale);

}  // namespace septet::gltf
