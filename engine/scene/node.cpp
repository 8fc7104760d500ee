#include "engine/scene/node.hpp"

#include <string_view>

namespace septet::scene {
namespace {

template <class Layers>
auto find_by_name(const Layers& layers, std::string_view name) -> const typename Layers::mapped_type* {
  for (const auto& [id, layer] : layers)
    if (layer.name == name) return &layer;
  return nullptr;
}

}  // namespace

bool is_drawn_tag_group(std::string_view name) {
  return name == "draw" || name == "surface" || name == "image" || name == "body";
}

const TagValue* find_tag(const Node& node, std::string_view group, std::string_view tag) {
  const TagGroup* in_group = find_by_name(node.tag_groups, group);
  const Tag* found = in_group ? find_by_name(in_group->tags, tag) : nullptr;
  return found ? &found->value : nullptr;
}

const GeometryLayer* find_layer(const GeometryData& geometry, std::string_view name) {
  return find_by_name(geometry.layers, name);
}

const BitmapLayer* find_layer(const BitmapData& bitmap, std::string_view name) {
  return find_by_name(bitmap.layers, name);
}

}  // namespace septet::scene
