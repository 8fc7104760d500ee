#pragma once
/// What a display shows of a scene's light: the twin of shaders/tone_curve.glsl.
///
/// The filmic curve of Hejl and Burgess-Dawson (Filmic Worlds, 2010): exposed light, 1 about white, to the display's code from
/// 0 to 1. It holds the display's gamma, and bends towards white as film does, so that what is far brighter than white still
/// differs a little.

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace septet::instant {

inline glm::vec3 display_code(const glm::vec3& exposed) {
  const glm::vec3 x = glm::max(glm::vec3(0.0f), exposed - 0.004f);
  return x * (6.2f * x + 0.5f) / (x * (6.2f * x + 1.7f) + 0.06f);
}

}  // namespace septet::instant
