#pragma once
/// Directions around a normal, and how they are drawn at random.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
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

/// Cosine and sine of a share of the full turn, in [0, 1); within 4e-7, and the same on every machine, which a library's need not be.
[[gnu::always_inline]] inline glm::vec2 on_circle(float share) {
  const float eighths = 8.0f * share;
  const int octant = static_cast<int>(eighths);
  // Of the angle from the nearest axis, at most an eighth.
  const float x = (eighths - static_cast<float>((octant + 1) & ~1)) * (0.25f * pi), x2 = x * x;
  const float sine = x * (1.0f + x2 * (-1.0f / 6.0f + x2 * (1.0f / 120.0f + x2 * (-1.0f / 5040.0f))));
  const float cosine = 1.0f + x2 * (-0.5f + x2 * (1.0f / 24.0f + x2 * (-1.0f / 720.0f + x2 * (1.0f / 40320.0f))));
  // By bits, for a branch would be guessed wrongly half of the time: each odd quarter exchanges the two, two quarters turn a sign.
  const auto quarter = static_cast<std::uint32_t>((octant + 1) >> 1);
  const std::uint32_t c = std::bit_cast<std::uint32_t>(cosine), s = std::bit_cast<std::uint32_t>(sine);
  const std::uint32_t exchanged = (c ^ s) & (0u - (quarter & 1u));
  return {std::bit_cast<float>(c ^ exchanged ^ ((quarter ^ (quarter << 1)) & 2u) << 30),
          std::bit_cast<float>(s ^ exchanged ^ (quarter & 2u) << 30)};
}

/// About z, with density cosine / π.
inline glm::vec3 cosine_direction(const glm::vec2& random) {
  return {std::sqrt(random.x) * on_circle(random.y), std::sqrt(1.0f - random.x)};
}

/// Weight of a sample of density `pdf` where another strategy would have drawn it with density `other`: Veach's power heuristic.
inline float mis_weight(float pdf, float other) { return pdf * pdf / std::max(pdf * pdf + other * other, 1e-37f); }

}  // namespace septet::raytrace
