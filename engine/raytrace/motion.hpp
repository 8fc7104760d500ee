#pragma once
/// Placement of a mesh, and its motion while the shutter is open.

#include <array>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace septet::raytrace {

/// Longest displacement while a shutter is open; beyond it the object has gone, and another one is there.
inline constexpr double longest_way_m = 10.0;

/// Placement: a vertex is at origin_m + turn · position_m.
struct Stand {
  glm::vec3 origin_m{0.0f};
  glm::mat3 turn{1.0f};  ///< Rotation, after a stretch along the mesh's axes.
  bool operator==(const Stand&) const = default;
};

/// Motion between two placements: along a straight line, turning evenly about one axis by less than half a circle.
class Motion {
 public:
  struct Key {
    glm::vec3 origin_m{0.0f}, stretch{1.0f};
    glm::quat turn{1.0f, 0.0f, 0.0f, 0.0f};
  };
  Motion(const Stand& from, const Stand& to);
  Stand at(float time) const;  ///< `time`: 0 to 1.
  const std::array<Key, 2>& keys() const { return keys_; }

 private:
  std::array<Key, 2> keys_;
};

}  // namespace septet::raytrace
