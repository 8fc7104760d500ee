#pragma once
/// Content of an object node as a picture needs it, read once per change of it (CONVENTIONS.md).

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/math/pose_keys.hpp"
#include "engine/scene/node.hpp"
#include "engine/scene/pushable_box.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::scene {

/// Materials by face material index, rising.
using FaceMaterials = std::vector<std::pair<std::uint32_t, NodeId>>;

/// Objects above one another from which on those below are not drawn: children may form a loop.
inline constexpr std::size_t deepest_child = 32;

struct DrawnObject {
  std::optional<std::string> prototype;  ///< Name of the prototype that it is; none: it is placed in the world.
  Transform transform;                   ///< Of what moves the scale alone.
  Motion motion;                         ///< With legs: drawn at its motion's pose, as a prototype of its own.
  std::optional<PushableBox> box;        ///< Likewise drawn where its box was pushed to; its motion may have no legs.
  bool hidden = false;
  NodeId geometry = no_node;
  FaceMaterials materials;
  std::vector<NodeId> children;
  float visible_from_m = 0.0f, visible_to_m = 1e9f;
  PartRole role = PartRole::fixed;
  bool casts_shadow = true;
  std::optional<glm::vec3> paint;  ///< Of a prototype.
  std::vector<PoseKey> keys;       ///< Moves by them, if any; `transform` is its pose at rest.

  bool operator==(const DrawnObject&) const = default;
};

/// `node` is an object.
DrawnObject read_object(const Node& node);

}  // namespace septet::scene
