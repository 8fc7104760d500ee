#pragma once
/// A corner of ice's surface, as the models of ice make it and renderers draw it.

#include <glm/vec3.hpp>

namespace septet::ice {

/// `rest_m`: where the point lay in the whole body before anything moved or broke, which is what unevenness, cracks and air keep
/// to. Of what is inside (engine/effects/ice/cracks.hpp): texture coordinates, and which kind it is.
struct IceVertex {
  glm::vec3 position_m{0.0f};
  glm::vec3 normal{0.0f};
  glm::vec3 rest_m{0.0f};
};

}  // namespace septet::ice
