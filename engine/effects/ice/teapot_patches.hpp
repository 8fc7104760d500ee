#pragma once
/// The teapot's 32 bicubic Bézier patches, from Martin Newell's measures (1975): six profiles turned about the axis, a
/// quarter each with circles' tangents of 0.56, and halves of handle and spout with their mirror images.

#include <array>
#include <vector>

#include <glm/vec3.hpp>

namespace septet::ice {

struct TeapotPatch {
  std::array<std::array<glm::vec3, 4>, 4> points;  ///< points[row along v][column along u]; ∂u × ∂v points outwards.
  glm::vec3 at(float u, float v) const;
};

std::vector<TeapotPatch> teapot_patches();

}  // namespace septet::ice
