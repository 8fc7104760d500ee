#include "engine/scene/material_evaluation.hpp"

#include <algorithm>
#include <cstddef>
#include <variant>

#include <glm/vec3.hpp>

namespace septet::scene {
namespace {

template <class T>
T tag_or(const Node& node, const char* name, T otherwise) {
  const TagValue* value = find_tag(node, "surface", name);
  const T* typed = value ? std::get_if<T>(value) : nullptr;
  return typed ? *typed : otherwise;
}

/// Finite and moderate numbers for a renderer, for any tree.
glm::vec3 moderate(const glm::vec3& color, float most) {
  const auto one = [&](float value) { return value > 0.0f ? std::min(value, most) : 0.0f; };
  return {one(color.r), one(color.g), one(color.b)};
}

/// The lobe whose colour is the base colour.
const Lobe& base_lobe(const Lobes& lobes) {
  return mean_of_channels(lobes.lit.color) > 0.0f ? lobes.lit : lobes.mirror;
}

}  // namespace

FinishTags finish_tags(const Node& node) {
  const auto number = [&](const char* name) -> std::optional<double> {
    const TagValue* value = find_tag(node, "surface", name);
    const double* typed = value ? std::get_if<double>(value) : nullptr;
    return typed ? std::optional(*typed) : std::nullopt;
  };
  return {number("roughness"), number("metallic")};
}

SurfaceNumbers surface_numbers(const Lobes& lobes, const FinishTags& tags) {
  const float through = std::clamp(mean_of_channels(lobes.through.color), 0.0f, 1.0f), opaque = 1.0f - through;
  const float mirror = mean_of_channels(lobes.mirror.color), lit = mean_of_channels(lobes.lit.color);
  const Lobe& base = base_lobe(lobes);
  const bool polished = mirror > 0.0f;
  const double metallic = polished ? std::clamp(mirror / (mirror + std::max(lit, 0.0f)), 0.0f, 1.0f) : 0.0;
  const double roughness = polished ? 0.1 : SurfaceMaterial{}.roughness;
  SurfaceNumbers numbers;
  numbers.base_color = moderate(opaque > 0.0f ? base.color / opaque : base.color, 1.0f);
  numbers.emission = moderate(lobes.plain.color, 1e6f);
  numbers.opacity = opaque;
  numbers.metallic = static_cast<float>(std::clamp(tags.metallic.value_or(metallic), 0.0, 1.0));
  numbers.roughness = static_cast<float>(std::clamp(tags.roughness.value_or(roughness), 0.0, 1.0));
  return numbers;
}

void set_numbers(const SurfaceNumbers& numbers, SurfaceMaterial& material) {
  material.base_color = numbers.base_color;
  material.emission = numbers.emission;
  material.opacity = numbers.opacity;
  material.roughness = numbers.roughness;
  material.metallic = numbers.metallic;
}

SurfaceMaterial evaluate_material(const Node& node, const std::function<std::int32_t(NodeId)>& image_of) {
  const auto* data = std::get_if<MaterialData>(&node.data);
  SurfaceMaterial material;
  if (!data) return material;
  const Lobes lobes = evaluate_lobes(*data);
  set_numbers(surface_numbers(lobes, finish_tags(node)), material);
  material.refraction_index = std::clamp(lobes.refraction_index, 1.0f, 4.0f);
  if (lobes.exact) {
    const Lobe& base = base_lobe(lobes);
    if (base.image != no_node) material.base_color_image = image_of(base.image);
    if (lobes.plain.image != no_node) material.maps[SurfaceMap::emission] = image_of(lobes.plain.image);
  }
  material.takes_paint = tag_or(node, "takes_paint", false);
  material.wettable = tag_or(node, "wettable", false);
  material.stripe = tag_or(node, "stripe", false);
  material.retroreflection = static_cast<float>(std::clamp(tag_or(node, "retroreflection", 0.0), 0.0, 1e4));
  material.picture_columns = std::clamp(tag_or(node, "picture_columns", 1u), 1u, 64u);
  material.picture_rows = std::clamp(tag_or(node, "picture_rows", 1u), 1u, 64u);
  material.clear_coat = static_cast<float>(std::clamp(tag_or(node, "clear_coat", 0.0), 0.0, 1.0));
  material.share_of_sky = static_cast<float>(std::clamp(tag_or(node, "share_of_sky", 1.0), 0.0, 1.0));
  material.two_sided = tag_or(node, "two_sided", false);
  material.ambient_share = static_cast<float>(std::clamp(tag_or(node, "ambient_share", 1.0), 0.0, 1.0));
  material.lit_by_night = tag_or(node, "lit_by_night", false);
  material.in_street = tag_or(node, "in_street", false);
  for (std::size_t map = 0; map < surface_map_count; ++map)
    if (const NodeId bitmap = tag_or(node, surface_map_tags[map], NodeReference{}).node; bitmap != no_node)
      material.maps.values[map] = image_of(bitmap);
  material.by_second_uv = tag_or(node, "by_second_uv", 0u) & ((1u << surface_map_count) - 1u);
  return material;
}

}  // namespace septet::scene
