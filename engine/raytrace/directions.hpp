#pragma once
/// Directions around a normal, and how they are drawn at random.

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace septet::raytrace {

inline constexpr float pi = std::numbers::pi_v<float>;

/// What a colour weighs where one number must decide: Rec. 709's luminance.
inline float luminance(const glm::vec3& color) { return glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f)); }

/// Two axes that make a right-handed frame with a unit `axis` (Duff et al., "Building an Orthonormal Basis, Revisited", 2017).
struct Frame {
  glm::vec3 across, along, axis;

  explicit Frame(const glm::vec3& n) : axis(n) {
    const float sign = std::copysign(1.0f, n.z), a = -1.0f / (sign + n.z), b = n.x * n.y * a;
    across = {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x};
    along = {b, sign + n.y * n.y * a, -n.y};
  }
  glm::vec3 to_world(const glm::vec3& local) const { return across * local.x + along * local.y + axis * local.z; }
  glm::vec3 to_local(const glm::vec3& world) const {
    return {glm::dot(world, across), glm::dot(world, along), glm::dot(world, axis)};
  }
};

inline glm::vec3 from_angles(float cosine, float azimuth_rad) {
  const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
  return {sine * std::cos(azimuth_rad), sine * std::sin(azimuth_rad), cosine};
}

/// About z, with density cosine / π.
inline glm::vec3 cosine_direction(const glm::vec2& random) {
  const float radius = std::sqrt(random.x), azimuth_rad = 2.0f * pi * random.y;
  return {radius * std::cos(azimuth_rad), radius * std::sin(azimuth_rad), std::sqrt(1.0f - random.x)};
}

/// Weight of a sample of density `pdf` where another strategy would have drawn it with density `other`: Veach's power heuristic.
inline float mis_weight(float pdf, float other) { return pdf * pdf / std::max(pdf * pdf + other * other, 1e-37f); }

}  // namespace septet::raytrace
