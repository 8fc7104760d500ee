#pragma once
/// Cover of glass at a point of it (OnGlass of ice_body.hpp): engine/light/frost.hpp and crack.hpp, with the noise.

#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

namespace septet::instant {

/// Share of what lies behind that frost hides. `rest_m`: of ice::frost_surface. `noise`: cloud_noise().
float frost_hides(std::span<const std::uint8_t> noise, const glm::vec3& rest_m);

struct CrackSeen {
  float hides = 0.0f;      ///< Share of what lies behind; nothing beside the crack in its strip.
  bool crushed = false;    ///< Grains, which scatter; else a face, which mirrors.
  float albedo = 0.0f;     ///< Of grains.
  glm::vec3 normal{0.0f};  ///< Unit, of the face: uneven along the crack.
};
/// `rest_m` and `normal` (unit): of ice::star_surface.
CrackSeen crack_seen(std::span<const std::uint8_t> noise, const glm::vec3& rest_m, const glm::vec3& normal);

}  // namespace septet::instant
