#pragma once
/// A material node's shading tree as the few numbers of SurfaceMaterial (CONVENTIONS.md, "Materials").

#include <functional>

#include "engine/scene/node.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::scene {

/// `image_of` returns the index of a bitmap's image, or -1. The revision is left at zero.
SurfaceMaterial evaluate_material(const Node& node, const std::function<std::int32_t(NodeId)>& image_of);

}  // namespace septet::scene
