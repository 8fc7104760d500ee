#pragma once
/// Things whose content takes several messages, and whether a store shows one without it.

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "engine/scene/command.hpp"
#include "engine/scene/store.hpp"

namespace septet::replication {

inline constexpr std::uint32_t vertices_of_a_thing = 12'000;  // 144 KB.

/// The object `first`, with a shape and a look of the next two ids.
inline std::vector<scene::Command> commands_of_a_thing(scene::NodeId first) {
  using namespace scene;
  const NodeId shape = first + 1, look = first + 2;
  std::vector<glm::vec3> positions_m(vertices_of_a_thing);
  for (std::size_t i = 0; i < positions_m.size(); ++i) positions_m[i] = {0.1f + static_cast<float>(i), 0.3f, 1.7f};
  return {NodeCreate{first, NodeType::object},
          NodeCreate{shape, NodeType::geometry},
          GeometrySizeSet{shape, vertices_of_a_thing, 1},
          VerticesSet{shape, 0, positions_m},
          NodeCreate{look, NodeType::material},
          FragmentSet{look, 0, ColorFragment{{1, 0, 0}}},
          LinkSet{first, 0, {"geometry", shape, 0}},
          LinkSet{first, 1, {"material", look, 0}}};
}

/// True where every object that has a shape has all of it, and a look.
inline bool shows_nothing_bare(const scene::Store& store) {
  for (const auto& [id, node] : store.nodes()) {
    const auto* object = std::get_if<scene::ObjectData>(&node.data);
    if (!object || object->links.empty()) continue;
    if (object->links.size() != 2) return false;
    const scene::Node* shape = store.find(object->links.at(0).target);
    const scene::Node* look = store.find(object->links.at(1).target);
    if (!shape || !look || std::get<scene::MaterialData>(look->data).fragments.empty()) return false;
    const auto& vertices_m = std::get<scene::GeometryData>(shape->data).vertices_m;
    if (vertices_m.size() != vertices_of_a_thing || vertices_m.back() == glm::vec3(0.0f)) return false;
  }
  return true;
}

}  // namespace septet::replication
