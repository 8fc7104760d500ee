// Share of the light of sun or moon that smoke lets through to a place: moments mixed between four texels of the map.

#include "engine/light/smoke_shade.hpp"

layout(set = 0, binding = 24, std430) readonly buffer SmokeShade { vec4 smoke_shade[]; };

float left_by_smoke(vec3 relative) {
  vec4 place = vec4(relative, 1.0);
  vec2 at = vec2(dot(view.smoke_shade_x, place), dot(view.smoke_shade_y, place));
  ivec2 low = ivec2(floor(at));
  if (any(lessThan(low, ivec2(0))) || any(greaterThanEqual(low, ivec2(smoke_shade_side - 1)))) return 1.0;
  vec2 share = at - vec2(low);
  int first = low.y * smoke_shade_side + low.x;
  vec3 below = mix(smoke_shade[first].xyz, smoke_shade[first + 1].xyz, share.x);
  vec3 above = mix(smoke_shade[first + smoke_shade_side].xyz, smoke_shade[first + smoke_shade_side + 1].xyz, share.x);
  return below_smoke(mix(below, above, share.y), dot(view.smoke_shade_height, place));
}
