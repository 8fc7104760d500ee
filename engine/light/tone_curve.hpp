#ifndef SEPTET_LIGHT_TONE_CURVE_HPP
#define SEPTET_LIGHT_TONE_CURVE_HPP
/// Display codes of a scene's light.
///
/// The filmic curve of Hejl and Burgess-Dawson (Filmic Worlds, 2010): exposed light, 1 about white, to the display's code from
/// 0 to 1. It holds the display's gamma, so that neither a power nor an sRGB target is needed, and bends towards white as film does, so that what is
/// far brighter than white still differs a little.

#include "engine/light/language.hpp"

LIGHT_BEGIN

LIGHT_FN vec3 display_code(vec3 exposed) {
  const vec3 x = max(vec3(0.0f), exposed - 0.004f);
  return x * (6.2f * x + 0.5f) / (x * (6.2f * x + 1.7f) + 0.06f);
}

LIGHT_END

#endif
