#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"

#include "engine/light/records.hpp"

layout(set = 0, binding = 1, std430) readonly buffer WetLamps { WetLampRecord lamps[]; };

// x: metres to the side of the streak's middle, y: metres on the way to the lamp.
layout(location = 0) out vec2 out_at;
layout(location = 1) flat out vec3 out_color;  // Radiance in the middle, for a perfect mirror.
// Eye over the road, lamp over the road, way to the lamp, width of its light; m.
layout(location = 2) flat out vec4 out_heights;
// xy: direction to the lamp on the level, z: depth of a point a metre before it, w: height of its road relative to the
// eye, m.
layout(location = 3) flat out vec4 out_before;

void main() {
  WetLampRecord lamp = lamps[gl_InstanceIndex];
  const vec2 corners[6] = vec2[](vec2(-1, 0), vec2(1, 0), vec2(1, 1), vec2(-1, 0), vec2(1, 1), vec2(-1, 1));
  vec2 at = corners[gl_VertexIndex];
  float road = lamp.energy_road.w, distance_m = length(lamp.position_size.xy);
  // The road is taken as a slope from below the eye to the lamp's foot.
  float near_road = view.road.z > 0.0 ? view.road.w / view.road.z : road;
  vec2 ahead = lamp.position_size.xy / distance_m, aside = vec2(-ahead.y, ahead.x);
  float along = mix(0.05 * distance_m, 0.98 * distance_m, at.y);
  // Spread of the light by the water's tilt: to the sides, the lamp's height times the tilt; along the way to the lamp,
  // the distance from the mirroring point to the lamp times the tilt.
  float lamp_height = lamp.position_size.z - road, lens = 0.5 * lamp.position_size.w * lamp.position_size.w;
  float turns = 0.12 * lamp_height, ways = turns * distance_m / (lamp_height - near_road);
  // Width of at least 0.6 pixels: a narrower streak would break into dashes.
  float breadth = max(sqrt(lens + turns * turns), 0.6 * view.billboard_right.w * distance_m);
  float half_width = 2.5 * breadth * along / distance_m;
  out_at = vec2(at.x * half_width, along);
  out_color = lamp.energy_road.rgb * (exp2(-distance_m * view.sky_irradiance.w) / (pi * breadth * sqrt(lens + ways * ways)));
  vec4 before = view.clip_from_relative * vec4(ahead * (distance_m - min(1.0, 0.5 * distance_m)), road, 1.0);
  out_before = vec4(ahead, before.z / before.w, road);
  out_heights = vec4(-near_road, lamp_height, distance_m, breadth);
  vec3 place = vec3(ahead * along + aside * out_at.x, mix(near_road, road, along / distance_m));
  // Drawn before the road, which is less flat than the streak; the fragment shader leaves out the parts that then cover
  // objects on the road.
  gl_Position = view.clip_from_relative * vec4(place * (1.0 - 0.04), 1.0);
}
