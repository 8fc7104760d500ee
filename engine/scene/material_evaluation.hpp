#pragma once
/// A material node's shading tree as the few numbers of SurfaceMaterial (CONVENTIONS.md, "Materials").

#include <functional>
#include <optional>

#include <glm/vec3.hpp>

#include "engine/scene/material_lobes.hpp"
#include "engine/scene/node.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::scene {

/// Tags of the group `surface` that override what the tree says of the finish.
struct FinishTags {
  std::optional<double> roughness, metallic;
};
FinishTags finish_tags(const Node& node);

/// What the lobes of a tree come to, of a whole surface or of one place of it; finite and moderate for any tree.
struct SurfaceNumbers {
  glm::vec3 base_color{0.0f}, emission{0.0f};
  float opacity = 1.0f, metallic = 0.0f, roughness = 0.7f;
};
SurfaceNumbers surface_numbers(const Lobes& lobes, const FinishTags& tags);
void set_numbers(const SurfaceNumbers& numbers, SurfaceMaterial& material);

/// Where the tree varies over the surface in a way that these numbers and one image cannot say (`Lobes::exact` is
/// false) they are its means, without an image of the tree's: material_baking.hpp makes the pictures.
/// `image_of` returns the index of a bitmap's image, or -1. The revision is left at zero.
SurfaceMaterial evaluate_material(const Node& node, const std::function<std::int32_t(NodeId)>& image_of);

}  // namespace septet::scene
