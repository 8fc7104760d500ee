#ifndef SEPTET_LIGHT_LAMPLIGHT_HPP
#define SEPTET_LIGHT_LAMPLIGHT_HPP
/// Light of standing lamps on a surface, and the even light of those under a roof.
///
/// A texel of the field of lamps (engine/render/passes/lamp_field.hpp) holds in x, y and z the sum of the light that arrives at the ground as a
/// vector toward where it comes from, in w its sum regardless of direction, negative where the lamps stand under a roof.

#include "engine/light/language.hpp"

LIGHT_BEGIN

/// Light of a texel that comes from all sides: what of the sum has no direction.
LIGHT_FN float from_all_sides(vec4 texel) {
  return 0.25f * max(0.0f, abs(texel.w) - length(vec3(texel.x, texel.y, texel.z)));
}

/// On a surface with that normal; `toward`: the texel's vector, as it is there.
LIGHT_FN float lamplight(vec3 toward, float from_all_sides, vec3 normal) {
  return max(0.0f, dot(toward, normal)) + from_all_sides;
}

/// Hue of lamps under a roof, their irradiance from all sides, and the part of it that reaches a surface besides the pools that they throw.
LIGHT_CONST vec3 roofed_hue = vec3(1.5f, 1.3f, 1.0f);
LIGHT_CONST vec3 roofed_irradiance = roofed_hue * 0.35f;
LIGHT_CONST vec3 irradiance_between_pools = roofed_hue * 0.24f;

/// Radiance of haze between an eye and a surface that are both under a roof.
LIGHT_CONST vec3 roofed_haze = roofed_irradiance / pi;

/// Share of such haze in all that lies between two places, by their shares of the sky.
LIGHT_FN float roofed_between(float one_share_of_sky, float other_share_of_sky) {
  return (1.0f - one_share_of_sky) * (1.0f - other_share_of_sky);
}

LIGHT_END

#endif
