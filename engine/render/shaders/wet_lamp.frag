#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"
#include "engine/light/wet_road.hpp"

layout(location = 0) in vec2 at;
layout(location = 1) flat in vec3 color;
layout(location = 2) flat in vec4 heights;
layout(location = 3) flat in vec4 before;
layout(location = 0) out vec4 result;

layout(set = 0, binding = 20) uniform sampler2D mirror_depth;  // Depth of the road's mirror image.

// True if an object stands higher than the line from this place to the lamp. Its mirror image lies on the road between
// here and the point where a level road mirrors the lamp: each of several places there gives the distance of one object
// before the lamp, and a lower bound of its height. The first place lies a little nearer than this one, since an object
// may stand right here.
bool is_hidden() {
  const int places = 8;
  float lamp_m = heights.z - min(1.0, 0.5 * heights.z), mirrors_lamp_m = max(heights.z * heights.x / (heights.x + heights.y), at.y);
  float place_m = 0.95 * at.y, times = pow(mirrors_lamp_m / place_m, 1.0 / float(places));
  bool hidden = false;
  for (int i = 0; i < (view.water.z > 0.0 ? places : 0); ++i, place_m *= times) {
    vec4 clip = view.clip_from_relative * vec4(before.xy * place_m, mix(-heights.x, before.w, place_m / heights.z), 1.0);
    float depth = textureLod(mirror_depth, 0.5 + 0.5 * clip.xy / clip.w, 0.0).r;
    float stands_m = lamp_m * before.z / max(depth, 1e-6);
    float way_m = heights.y * (stands_m - at.y) / (heights.z - at.y);
    hidden = hidden || (stands_m < lamp_m && heights.x * (stands_m - place_m) > way_m * place_m);
  }
  return hidden;
}

void main() {
  float grazing = heights.x / at.y;
  // A facet of the water reflects the lamp to the eye if it is tilted by half of the difference between the two angles
  // to the road.
  float tilt = 0.5 * (grazing - heights.y / (heights.z - at.y)) / 0.06;
  float side = at.x * heights.z / (heights.w * at.y);
  float mirrored = schlick(vec3(water_reflectance), grazing).x;
  float share = is_hidden() ? 0.0 : exp2(-1.44 * (tilt * tilt + side * side));
  result = vec4(color * (mirrored * share), smoothstep(0.001, 0.01, share));
}
