#include "engine/scene/drawn_object.hpp"

#include <algorithm>
#include <string_view>
#include <variant>

#include <glm/gtc/quaternion.hpp>

#include "engine/scene/keyed_part.hpp"
#include "engine/scene/part_role.hpp"

namespace septet::scene {
namespace {

template <class T>
T draw_tag(const Node& node, const char* name, T otherwise) {
  const TagValue* value = find_tag(node, "draw", name);
  const T* typed = value ? std::get_if<T>(value) : nullptr;
  return typed ? *typed : otherwise;
}

/// Metres, of any number.
float distance_tag(const Node& node, const char* name, float otherwise_m) {
  constexpr double most_m = 1e9;
  return static_cast<float>(std::clamp(draw_tag(node, name, double{otherwise_m}), -most_m, most_m));
}

}  // namespace

DrawnObject read_object(const Node& node) {
  const auto& data = std::get<ObjectData>(node.data);
  DrawnObject object;
  if (node.name.starts_with(prototype_prefix)) object.prototype = node.name.substr(prototype_prefix.size());
  object.transform = data.transform;
  object.transform.rotation = glm::normalize(data.transform.rotation);
  object.hidden = data.hidden;
  if (!object.prototype && !data.motion.legs.empty()) {
    object.motion = data.motion;
    object.motion.rotation = glm::normalize(data.motion.rotation);
    object.transform = {.scale = data.transform.scale};
  }
  if (!object.prototype) object.box = pushable_box(node);
  if (object.box && object.motion.legs.empty()) {
    object.motion = {object.transform.position_m, object.transform.rotation, {}};
    object.transform = {.scale = data.transform.scale};
  }
  for (const auto& [id, link] : data.links) {
    if (link.label == "geometry" && object.geometry == no_node) object.geometry = link.target;
    if (link.label == "material") object.materials.emplace_back(link.target_id, link.target);
    if (link.label == "child") object.children.push_back(link.target);
  }
  std::stable_sort(object.materials.begin(), object.materials.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  object.visible_from_m = distance_tag(node, "from_m", object.visible_from_m);
  object.visible_to_m = distance_tag(node, "to_m", object.visible_to_m);
  object.role = part_role(draw_tag(node, "role", std::string()));
  object.casts_shadow = draw_tag(node, "casts_shadow", true);
  object.keys = keys_of(node);
  if (const TagValue* paint = find_tag(node, "draw", "paint"); paint && object.prototype)
    if (const auto* rgb = std::get_if<Vec3>(paint)) object.paint = glm::clamp(glm::vec3(*rgb), 0.0f, 1.0f);
  return object;
}

}  // namespace septet::scene
