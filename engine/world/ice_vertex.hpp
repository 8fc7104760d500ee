#pragma once
/// A corner of ice's surface, as the models of ice make it and renderers draw it.

#include <glm/vec3.hpp>

namespace septet::ice {

/// Vertex of ice; `rest_m`: its place in the whole body before any motion or fracture, to which unevenness, cracks and
/// air are fixed. Of the inside (engine/effects/ice/cracks.hpp): texture coordinates, and its kind.
struct IceVertex {
  glm::vec3 position_m{0.0f};
  glm::vec3 normal{0.0f};
  glm::vec3 rest_m{0.0f};
};

}  // namespace septet::ice
