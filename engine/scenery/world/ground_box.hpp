#pragma once
/// Boxes of one ground or finish, of which furniture and buildings are put together.

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/scenery/world/world_finish.hpp"

namespace septet::scenery {

inline void add_box(geometry::MeshBuilder& builder, Ground ground, const glm::vec3& low, const glm::vec3& high) {
  builder.material = index_of(ground);
  builder.append(geometry::box(low, high), glm::mat4(1.0f), true);
}

}  // namespace septet::scenery
