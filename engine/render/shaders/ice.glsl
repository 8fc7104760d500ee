// One body of ice: what the passes of ice know of it.

#include "engine/light/fresnel.hpp"
#include "engine/light/ice_optics.hpp"
#include "engine/light/records.hpp"

layout(push_constant) uniform Ice { IceConstants ice; };

layout(set = 0, binding = 6) uniform sampler2D ice_front;   // Normal, distance along forward; 0: nothing is there.
layout(set = 0, binding = 7) uniform sampler2D ice_back;    // The same of the back face behind it.
layout(set = 0, binding = 8) uniform sampler2D ice_inside;  // What cracks and air add, and how much they hide.
layout(set = 0, binding = 9) uniform samplerCube surroundings;
layout(set = 0, binding = 10) uniform sampler2D ice_beyond;       // As ice_front, of what begins behind that back face.
layout(set = 0, binding = 11) uniform sampler2D ice_beyond_back;  // Of the back face behind that.

// Cube maps are left-handed: two axes are exchanged.
vec3 around(vec3 direction) { return textureLod(surroundings, direction.xzy, 0.0).rgb; }
