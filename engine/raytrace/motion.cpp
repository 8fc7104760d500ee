#include "engine/raytrace/motion.hpp"

#include <glm/geometric.hpp>

namespace septet::raytrace {
namespace {

Motion::Key key_of(const Stand& stand) {
  Motion::Key key;
  key.origin_m = stand.origin_m;
  glm::mat3 turn = stand.turn;
  for (int axis = 0; axis < 3; ++axis) {
    key.stretch[axis] = glm::length(turn[axis]);
    if (key.stretch[axis] > 0.0f) turn[axis] /= key.stretch[axis];
  }
  // Mirrored placements are not rotated into their image: the mirroring goes to the stretch.
  if (glm::determinant(turn) < 0.0f) turn[0] = -turn[0], key.stretch[0] = -key.stretch[0];
  key.turn = glm::normalize(glm::quat_cast(turn));
  return key;
}

}  // namespace

Motion::Motion(const Stand& from, const Stand& to) : keys_{key_of(from), key_of(to)} {
  if (glm::dot(keys_[0].turn, keys_[1].turn) < 0.0f) keys_[1].turn = -keys_[1].turn;
}

Stand Motion::at(float time) const {
  const auto& [from, to] = keys_;
  const glm::vec3 stretch = glm::mix(from.stretch, to.stretch, time);
  const glm::mat3 turn = glm::mat3_cast(glm::slerp(from.turn, to.turn, time));
  return {glm::mix(from.origin_m, to.origin_m, time),
          glm::mat3(turn[0] * stretch.x, turn[1] * stretch.y, turn[2] * stretch.z)};
}

}  // namespace septet::raytrace
