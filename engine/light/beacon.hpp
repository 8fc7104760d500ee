#ifndef SEPTET_LIGHT_BEACON_HPP
#define SEPTET_LIGHT_BEACON_HPP
/// Light of an emergency vehicle's beacons on what is around them.
///
/// A beacon is a box that shines all over and stands on a roof. The ray tracer has box and roof themselves and is what the
/// numbers here are fitted to (tests/images/beacon_slow_test.cpp). The rasteriser takes the box as a point that shines as
/// strongly as the area seen of it, of which the roof hides the more the lower one stands.
/// Directions are unit vectors along the world's axes.

#include "engine/light/language.hpp"

LIGHT_BEGIN

/// Area of its lid as a multiple of its mean side's.
LIGHT_CONST float beacon_lid = 1.4f;

/// A lens's heights that the roof reaches beyond it, ahead and aside, where it is rounded.
LIGHT_CONST float roof_ahead = 7.0f;
LIGHT_CONST float roof_aside = 0.8f;

/// Intensity in the direction `from_lamp` as a multiple of that on the level. `ahead`: of the vehicle, unit, on the
/// level.
LIGHT_FN float beacon_share(vec3 from_lamp, vec2 ahead) {
  const float along = abs(from_lamp.x * ahead.x + from_lamp.y * ahead.y);
  const float across = abs(from_lamp.x * ahead.y - from_lamp.y * ahead.x);
  const float level = sqrt(max(0.0f, 1.0f - from_lamp.z * from_lamp.z));
  // A way down leaves the roof where it first comes to one of its edges.
  const float clear = max(max(along / roof_ahead, across / roof_aside), 1e-4f);
  const float seen = max(0.0f, 1.0f - max(0.0f, -from_lamp.z) / clear);
  return level * seen + beacon_lid * max(0.0f, from_lamp.z);
}

/// Irradiance of a surface with that normal, per unit of intensity on the level; `to_lamp`: m. At the lamp it does not
/// grow without limit.
LIGHT_FN float beacon_irradiance(vec3 to_lamp, vec3 normal, vec2 ahead) {
  const float square = max(dot(to_lamp, to_lamp), 1e-6f), per_m = inversesqrt(square);
  return max(0.0f, dot(normal, to_lamp)) * per_m * beacon_share(-per_m * to_lamp, ahead) / (square + 0.1f);
}

LIGHT_END

#endif
