#ifndef SEPTET_LIGHT_SURFACE_MAPS_HPP
#define SEPTET_LIGHT_SURFACE_MAPS_HPP
/// Images of a material beside its base colour's: what their texels mean (scene::SurfaceMap).

#include "engine/light/language.hpp"

LIGHT_BEGIN

/// Least roughness where an image has it: a highlight below it is a point that pixels miss.
LIGHT_CONST float least_mapped_roughness = 0.05f;

/// Unit normal of the world that a texel of a normal map gives (glTF 2.0, 3.9.3). `normal`: unit, interpolated, on the
/// triangle's front. `along_u`, `along_v`: how the place moves as each coordinate rises, to any factor above 0. As
/// MikkTSpace has it (glTF 2.0, 3.7.2.1), the tangent is that along u, made upright to the normal, and the third axis
/// stands on both, up in the picture; it is the triangle's own, not a mean of those around a vertex. Without a
/// direction along u, the normal itself.
LIGHT_FN vec3 mapped_normal(vec3 texel, vec3 normal, vec3 along_u, vec3 along_v) {
  vec3 tangent = along_u - normal * dot(normal, along_u);
  float square = dot(tangent, tangent);
  if (!(square > 1e-20f * dot(along_u, along_u))) return normal;
  tangent = tangent * inversesqrt(square);
  vec3 up = cross(normal, tangent);
  if (dot(up, along_v) > 0.0f) up = -up;
  vec3 tilt = texel * 2.0f - vec3(1.0f, 1.0f, 1.0f);
  return normalize(tangent * tilt.x + up * tilt.y + normal * max(tilt.z, 1e-2f));
}

LIGHT_END

#endif
