#pragma once
/// Directions around a normal, and random draws of them.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <type_traits>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/raytrace/eight.hpp"

namespace septet::raytrace {

inline constexpr float pi = std::numbers::pi_v<float>;

/// Luminance by Rec. 709.
inline float luminance(const glm::vec3& color) { return glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f)); }

/// Right-handed frame about a unit `axis`, or eight (Duff et al., "Building an Orthonormal Basis, Revisited", 2017).
template <typename Vector>
struct FrameOf {
  Vector across, along, axis;

  explicit FrameOf(const Vector& n) : axis(n) {
    const auto sign = sign_of(n.z), a = -1.0f / (sign + n.z), b = n.x * n.y * a;
    across = {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x};
    along = {b, sign + n.y * n.y * a, -n.y};
  }
  Vector to_world(const Vector& local) const { return across * local.x + along * local.y + axis * local.z; }
  Vector to_local(const Vector& world) const { return {dot(world, across), dot(world, along), dot(world, axis)}; }
};
using Frame = FrameOf<glm::vec3>;

inline glm::vec3 from_angles(float cosine, float azimuth_rad) {
  const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
  return {sine * std::cos(azimuth_rad), sine * std::sin(azimuth_rad), cosine};
}

/// Cosine and sine of a share of the full turn in [0, 1), or of eight: within 4e-7, and the same on every machine,
/// which a library's need not be.
template <typename Real>
struct OnCircle {
  Real cosine, sine;

  [[gnu::always_inline]] explicit OnCircle(Real share) {
    using Bits = std::conditional_t<std::is_same_v<Real, float>, std::uint32_t, Bits8>;
    const Real eighths = 8.0f * share;
    const auto octant = whole(eighths);
    // Angle from the nearest axis, at most an eighth of the turn.
    const Real x = (eighths - number((octant + 1) & ~1)) * (0.25f * pi), x2 = x * x;
    const Real s = x * (1.0f + x2 * (-1.0f / 6.0f + x2 * (1.0f / 120.0f + x2 * (-1.0f / 5040.0f))));
    const Real c = 1.0f + x2 * (-0.5f + x2 * (1.0f / 24.0f + x2 * (-1.0f / 720.0f + x2 * (1.0f / 40320.0f))));
    // Bits instead of a branch, which would be mispredicted half of the time: each odd quarter exchanges the two, two
    // quarters turn a sign.
    const Bits quarter = std::bit_cast<Bits>((octant + 1) >> 1);
    const Bits c_bits = std::bit_cast<Bits>(c), s_bits = std::bit_cast<Bits>(s);
    const Bits exchanged = (c_bits ^ s_bits) & (0u - (quarter & 1u));
    cosine = std::bit_cast<Real>(c_bits ^ exchanged ^ ((quarter ^ (quarter << 1)) & 2u) << 30);
    sine = std::bit_cast<Real>(s_bits ^ exchanged ^ (quarter & 2u) << 30);
  }
};
[[gnu::always_inline]] inline glm::vec2 on_circle(float share) {
  const OnCircle at(share);
  return {at.cosine, at.sine};
}

/// Direction about z with density cosine / π, from two numbers in [0, 1).
template <typename Vector, typename Real>
[[gnu::always_inline]] inline Vector cosine_direction_of(Real random, Real share) {
  const Real radius = root(random);
  const OnCircle at(share);
  return {radius * at.cosine, radius * at.sine, root(1.0f - random)};
}
inline glm::vec3 cosine_direction(const glm::vec2& random) {
  return cosine_direction_of<glm::vec3>(random.x, random.y);
}

/// Weight of a sample of density `pdf` where another strategy would have drawn it with density `other`: Veach's power
/// heuristic.
inline float mis_weight(float pdf, float other) { return pdf * pdf / std::max(pdf * pdf + other * other, 1e-37f); }

}  // namespace septet::raytrace
