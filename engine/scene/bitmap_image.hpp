#pragma once
/// A bitmap node as an image (CONVENTIONS.md, "Bitmaps").

#include "engine/scene/node.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::scene {

/// Empty where the node has no colour layer. The revision is left at zero.
TextureImage image_of_bitmap(const Node& node);

}  // namespace septet::scene
