// One body of ice, as the passes of ice read it.

#include "engine/light/fresnel.hpp"
#include "engine/light/ice_optics.hpp"
#include "engine/light/records.hpp"

layout(push_constant) uniform Ice { IceConstants ice; };

layout(set = 0, binding = 6) uniform sampler2D ice_front;   // Normal, distance along forward; 0: empty.
layout(set = 0, binding = 7) uniform sampler2D ice_back;    // Same of the back face behind it.
// Light added by cracks and air, and the share that they hide.
layout(set = 0, binding = 8) uniform sampler2D ice_inside;
layout(set = 0, binding = 9) uniform samplerCube surroundings;
// As ice_front, of the nearest front face behind that back face.
layout(set = 0, binding = 10) uniform sampler2D ice_beyond;
layout(set = 0, binding = 11) uniform sampler2D ice_beyond_back;  // Back face behind that one.

// Cube maps are left-handed: two axes are exchanged.
vec3 around(vec3 direction) { return textureLod(surroundings, direction.xzy, 0.0).rgb; }
