#pragma once
/// Weight of content against StoreLimits::bytes: its arrays and texts, and a share for the containers.

#include "engine/scene/node.hpp"

namespace septet::scene {

inline constexpr std::uint64_t container_bytes = 64;
inline std::uint64_t weight(const std::string& text) { return text.size(); }
inline std::uint64_t weight(const Tag& tag) {
  const auto* text = std::get_if<std::string>(&tag.value);
  const auto* blob = std::get_if<Blob>(&tag.value);
  return container_bytes + tag.name.size() + (text ? text->size() : 0) + (blob ? blob->size() : 0);
}
inline std::uint64_t weight(const TagGroup& group) {
  std::uint64_t sum = container_bytes + group.name.size();
  for (const auto& [id, tag] : group.tags) sum += weight(tag);
  return sum;
}
inline std::uint64_t weight(const Link& link) { return container_bytes + link.label.size(); }
inline std::uint64_t weight(const Motion& motion) { return motion.legs.size() * sizeof(MotionLeg); }
inline std::uint64_t weight(const GeometryLayer& layer) {
  return container_bytes + layer.name.size() + 4 * (layer.integers.size() + layer.reals.size());
}
inline std::uint64_t weight(const Fragment& fragment) {
  const auto* ramp = std::get_if<RampFragment>(&fragment);
  return 4 * container_bytes + (ramp ? ramp->points.size() * sizeof(RampPoint) : 0);
}
inline std::uint64_t weight(const BitmapLayer& layer) {
  return container_bytes + layer.name.size() + layer.tiles.size();
}
template <class Parts>
inline std::uint64_t weight_of_all(const Parts& parts) {
  std::uint64_t sum = 0;
  for (const auto& [id, part] : parts) sum += weight(part);
  return sum;
}
inline std::uint64_t shape_weight(std::uint64_t vertices, std::uint64_t polygons) {
  return vertices * sizeof(glm::vec3) + polygons * sizeof(PolygonCorners);
}
inline std::uint64_t weight(const Node& node) {
  std::uint64_t sum = 4 * container_bytes + node.name.size() + weight_of_all(node.tag_groups);
  if (const auto* object = std::get_if<ObjectData>(&node.data))
    sum += weight_of_all(object->links) + weight(object->motion);
  if (const auto* geometry = std::get_if<GeometryData>(&node.data))
    sum += shape_weight(geometry->vertices_m.size(), geometry->polygons.size()) + weight_of_all(geometry->layers);
  if (const auto* material = std::get_if<MaterialData>(&node.data)) sum += weight_of_all(material->fragments);
  if (const auto* bitmap = std::get_if<BitmapData>(&node.data)) sum += weight_of_all(bitmap->layers);
  return sum;
}

}  // namespace septet::scene
