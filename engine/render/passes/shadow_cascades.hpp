#pragma once
/// Shadow cascades: two orthographic views along the light around the eye, a fine one near it, a coarse one further
/// out.
///
/// They depend on the eye and the light alone, not on the direction of a screen, so that the shadows of neighbouring
/// screens agree; and they move in whole texels over the world, so that static shadows do not crawl.

#include <array>
#include <cstdint>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/instant/atmosphere.hpp"
#include "engine/math/rigid_transform.hpp"

namespace septet::render {

inline constexpr std::size_t cascade_count = 2;
inline constexpr std::uint32_t cascade_texels = 1024;

struct Cascade {
  glm::vec3 right{0.0f}, up{0.0f}, to_light{0.0f};  ///< World axes of the light's view.
  glm::vec2 middle_m{0.0f};                         ///< Centre along right and up, relative to the eye.
  float half_side_m = 1.0f;
  float half_depth_m = 1.0f;
  float texel_m = 1.0f;
  glm::vec2 first_texel{0.0f};  ///< Index over the world of its corner's texel, modulo cascade_texels.
};

struct ShadowCascades {
  Vec3 eye_m{0.0};  ///< World.
  std::array<Cascade, cascade_count> cascades;
};

/// True if shadows of the light are visible; else no cascade is drawn or sampled (shaders/sunlit.glsl). A low sun
/// behind clouds at dusk gives a wall that faces it 5 % of the sky's light, and the road a quarter of a per cent; at
/// noon it is 14 %.
inline bool casts_shadows(const instant::SkyLight& light) {
  return light.light_irradiance.g >= 0.06f * light.sky_irradiance.g;
}

ShadowCascades shadow_cascades(const Vec3& eye_m, const glm::vec3& to_light);

/// Clip space of the cascade from points relative to its eye; depth grows towards the light.
glm::mat4 clip_from_relative(const Cascade& cascade);
/// Texture coordinates and depth from points relative to another eye, which lies `offset_m` from the cascade's.
glm::mat4 texture_from_relative(const Cascade& cascade, const glm::vec3& offset_m);
/// Texture coordinates of the far cascade from those of the near one: xy·near + zw. Depth is the same in both.
glm::vec4 far_from_near(const ShadowCascades& shadows);
/// True if a sphere lies wholly in the part of the cascade that is sampled, seen along the light.
bool holds(const Cascade& cascade, const glm::vec3& centre_m, float radius_m);
/// True if a sphere reaches into the cascade's square, seen along the light.
bool covers(const Cascade& cascade, const glm::vec3& centre_m, float radius_m);

}  // namespace septet::render
