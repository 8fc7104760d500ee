#pragma once
/// Cover of glass at one of its points (OnGlass of ice_body.hpp): engine/light/frost.hpp and crack.hpp, with the noise.

#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

namespace septet::instant {

/// Share of the background that frost hides. `rest_m`: of ice::frost_surface. `noise`: cloud_noise().
float frost_hides(std::span<const std::uint8_t> noise, const glm::vec3& rest_m);

struct CrackSeen {
  float hides = 0.0f;      ///< Share of the background; zero beside the crack in its strip.
  bool crushed = false;    ///< True for grains, which scatter; false for a face, which reflects.
  float albedo = 0.0f;     ///< Albedo of grains.
  glm::vec3 normal{0.0f};  ///< Normal of the face, unit: uneven along the crack.
};
/// Crack at a point; `rest_m` and `normal` (unit): of ice::star_surface.
CrackSeen crack_seen(std::span<const std::uint8_t> noise, const glm::vec3& rest_m, const glm::vec3& normal);

}  // namespace septet::instant
