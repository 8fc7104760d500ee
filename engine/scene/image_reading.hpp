#pragma once
/// The linear colour and alpha of an image at a place, as both renderers read it near to.

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "engine/scene/resolved_scene.hpp"

namespace septet::scene {

/// Between four pixels, or of the nearest one where the image is sharp or `filtered` is false. Black and opaque of an
/// empty image. Pure; any thread.
glm::vec4 read_image(const TextureImage& image, const glm::vec2& uv, bool filtered);

}  // namespace septet::scene
