#pragma once
/// What lies on glass at a point of it (OnGlass of ice_body.hpp): the twin of shaders/ice_glass.frag, which also fades what is finer
/// than a pixel.
///
/// Frost hides by Beer and Lambert what lies behind it, with the area that its grains have by their mass; its feathers, each a stem with barbs at
/// 60° to it, are where that mass lies. A crack is a face that stands steep in the glass and mirrors; crushed glass is grains.

#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

namespace septet::instant {

/// Of the light that falls on either side of frost, what leaves by both sides alike.
inline constexpr float frost_albedo = 0.88f;

/// Of a crack's face, which mirrors all light: as wide a highlight as that of shaders/ice_glass.frag.
inline constexpr float crack_roughness = 0.4f;

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
