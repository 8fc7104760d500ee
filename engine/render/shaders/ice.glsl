// One body of ice: what the passes of ice know of it. The host's twin is IceConstants in passes/ice_pass.hpp; the equations are
// those of engine/light/ice_optics.hpp.
//
// A body has a rectangle in the images of its layers, seen through a frustum that is fitted to it. That depends on the eye
// and the body alone, so that two screens see the same.

#include "engine/light/fresnel.hpp"
#include "engine/light/ice_optics.hpp"

layout(push_constant) uniform Ice {
  vec4 u, v;        // xyz: place in the layers, times the distance along forward. u.w: slope of the bumps. v.w: waves per metre.
  vec4 forward;     // xyz: unit, from the eye to the body. w: nearest distance along it.
  vec4 origin;      // xyz: of the body, relative to the eye. w: share of the sun's light that reaches it.
  vec4 blend;       // x: share of the front face's normal, y: of the back face's, signed. z: frost, w: 1 it reflects.
  vec4 absorption;  // rgb: per metre. w: the body's largest extent, m.
  vec4 rectangle;   // In the layers, texels: first and last corner.
  vec4 beyond;      // Of what lies behind it. x: how far light is followed, m; 0: not. y: the largest extent, m. z: behind its far end. w: the highlight's exponent.
} ice;

layout(set = 0, binding = 6) uniform sampler2D ice_front;   // Normal, distance along forward; 0: nothing is there.
layout(set = 0, binding = 7) uniform sampler2D ice_back;    // The same of the back face behind it.
layout(set = 0, binding = 8) uniform sampler2D ice_inside;  // What cracks and air add, and how much they hide.
layout(set = 0, binding = 9) uniform samplerCube surroundings;
layout(set = 0, binding = 10) uniform sampler2D ice_beyond;       // As ice_front, of what begins behind that back face.
layout(set = 0, binding = 11) uniform sampler2D ice_beyond_back;  // Of the back face behind that.

// Cube maps are left-handed: two axes are exchanged.
vec3 around(vec3 direction) { return textureLod(surroundings, direction.xzy, 0.0).rgb; }
