#pragma once
/// Where a mesh stands, and its way while the shutter is open.

#include <array>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace septet::raytrace {

/// Further nothing moves while a shutter is open: it has gone, and something else is there.
inline constexpr double longest_way_m = 10.0;

/// A vertex is at origin_m + turn · position_m.
struct Stand {
  glm::vec3 origin_m{0.0f};
  glm::mat3 turn{1.0f};  ///< Rotation, after a stretch along the mesh's axes.
  bool operator==(const Stand&) const = default;
};

/// From one stand to another: along a straight line, turning evenly about one axis by less than half a circle.
class Motion {
 public:
  struct Key {
    glm::vec3 origin_m{0.0f}, stretch{1.0f};
    glm::quat turn{1.0f, 0.0f, 0.0f, 0.0f};
  };
  Motion(const Stand& from, const Stand& to);
  Stand at(float time) const;  ///< 0 to 1.
  const std::array<Key, 2>& keys() const { return keys_; }

 private:
  std::array<Key, 2> keys_;
};

}  // namespace septet::raytrace
