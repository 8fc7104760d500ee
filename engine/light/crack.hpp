#ifndef SEPTET_LIGHT_CRACK_HPP
#define SEPTET_LIGHT_CRACK_HPP
/// Cracks in glass, and glass that is crushed where something hit it.
///
/// A crack is a face that stands steep in the glass and mirrors, uneven along its length; it covers a third of the strip that it is drawn in. Crushed
/// glass is grains, close in the middle and ragged outwards. `rest_m`: x along a crack, m, y across its strip, −1 to 1; of crushed glass the
/// place on the pane, and z 1 in its middle, 2 at its rim.

#include "engine/light/frost.hpp"
#include "engine/light/language.hpp"

LIGHT_BEGIN

/// Roughness of a crack's face, which mirrors all light: as wide a highlight as that of the rasteriser, with the exponent 40.
LIGHT_CONST float crack_roughness = 0.4f;

/// A crack's share of its strip.
LIGHT_CONST float crack_width = 1.0f / 3.0f;

/// Two numbers from 0 to 1 of the grain at a place of crushed glass.
LIGHT_FN vec2 crushed_grain(vec2 place) {
  return random_place(vec2(floor(place.x / 0.0014f), floor(place.y / 0.0014f)));
}

/// Share of what lies behind that a grain hides.
LIGHT_FN float crushed_hides(vec2 grain, float rest_z) {
  return clamp(2.5f - rest_z - 0.9f * grain.x, 0.0f, 1.0f) * 0.9f;
}

/// The face's normal there, unit.
LIGHT_FN vec3 uneven_crack(vec3 normal, float along_m) {
  return normalize(normal + 0.25f * vec3(cos(along_m * 61.0f), sin(along_m * 47.0f), cos(along_m * 83.0f + 1.0f)));
}

/// Place in the noise from which the contact of a crack's faces is read, by its uneven normal.
LIGHT_FN vec2 crack_noise_place(vec3 normal, float along_m) { return vec2(along_m * 3.0f + normal.x, normal.y); }

/// Share of what lies behind that a crack's face hides: less where its sides touch. `noise`: there, 0 to 1.
LIGHT_FN float crack_hides(float noise) { return mix(0.4f, 0.95f, smoothstep(0.15f, 0.5f, noise)); }

LIGHT_END

#endif
