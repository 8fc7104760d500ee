#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"
#include "ice.glsl"

// What lies on a pane of glass: frost, and cracks in it. Premultiplied radiance, and how much it hides. The sheet is so thin that nothing of
// what is seen through it is displaced: it needs none of the layers of ice.frag.

layout(constant_id = 0) const uint cracked = 0;  // Cracks instead of frost.

layout(location = 0) in vec3 relative;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 rest;
layout(location = 0) out vec4 result;

// Crystals that lie close hide the more the more of them there are: by Beer and Lambert, with the area that grains of 0.1 mm have by their
// mass, 3/(2 ρ r).
const float frost_m2pkg = 16.0;

vec2 random_place(vec2 cell) {
  uvec2 q = uvec2(ivec2(cell) + 4096) * uvec2(1597334677u, 3812015801u);
  uint h = (q.x ^ q.y) * 1597334677u;
  return vec2(h >> 16, (h * 747796405u) >> 16) / 65536.0;
}

// How much of the frost's mass lies here: feathers, each a stem with barbs at 60° to it, that grew until they met; 0.79 on average. And its
// variance within the pixel over its mean: what is finer than the pixel fades to its mean.
vec2 feathers(vec2 place, float pixel_m) {
  const float cell_m = 0.034;
  // Of the four cells around a place one has the feather that reaches it, or nearly.
  vec2 cell = floor(place / cell_m - 0.5);
  float nearest = 1e9, second = 1e9;
  vec2 feather = vec2(0.0);
  for (int k = 0; k < 4; ++k) {
    vec2 at = cell + vec2(k & 1, k >> 1), germ = random_place(at);
    vec2 off = place - (at + 0.15 + 0.7 * germ) * cell_m, way = normalize(fract(germ * 37.0) - 0.5 + 1e-4);
    vec2 own = vec2(dot(off, way), dot(off, vec2(-way.y, way.x)));
    float far = abs(own.x) * 0.55 + abs(own.y);
    second = min(second, max(far, nearest));
    feather = far < nearest ? own : feather;
    nearest = min(nearest, far);
  }
  float aside = abs(feather.y), along = feather.x - 0.577 * aside;
  float fine = 1.0 - smoothstep(0.0007, 0.0020, pixel_m), coarse = 1.0 - smoothstep(0.004, 0.015, pixel_m);
  float grain = textureLod(noise, place * 7.0, 0.0).r, wander = 6.0 * grain;
  float unseen = 0.28 * (1.0 - fine) + 0.1 * (1.0 - coarse);
  if (coarse <= 0.0) return vec2(0.79, unseen);
  float barbs = 0.5 + 0.5 * cos(along * (2.0 * pi / 0.0034) + wander);
  float twigs = 0.5 + 0.5 * cos((aside * 1.155 + 0.5 * along) * (2.0 * pi / 0.0013) + 2.0 * wander);
  float stem = exp(-aside * aside / (0.0007 * 0.0007));
  float seam = smoothstep(0.0, 0.004, second - nearest);
  float lies = 0.84 + fine * (1.1 * (barbs * barbs * barbs - 0.3125) * (0.7 + 0.6 * twigs) + 0.8 * stem - 0.044) + coarse * (grain - 0.492);
  return vec2(max(lies * mix(0.94, 0.55 + 0.45 * seam, coarse), 0.0), max(unseen, 1e-3));
}

// Light that comes to a direction from the whole half space before it, over pi.
vec3 light_from(vec3 n) { return irradiance_on(n) / pi; }

vec4 frost(vec3 eye, vec3 n, vec3 place) {
  vec2 across = dFdx(place.xy), down = dFdy(place.xy);
  if (place.z < 5e-5) return vec4(0.0);  // So little hides less than a code.
  float pixel_m = sqrt(max(abs(across.x * down.y - across.y * down.x), 1e-12));
  // The mean of Beer's law over a mass spread as a gamma distribution.
  vec2 lies = feathers(place.xy, pixel_m);
  float hidden = 1.0 - pow(1.0 + lies.y * frost_m2pkg * place.z, -lies.x / lies.y);
  // Multiply scattered: what falls on either face leaves by both alike, and little is lost.
  float share = 0.88 * ice.origin.w;
  vec3 sunlight = view.light_irradiance.rgb * share;
  vec3 light = 0.5 * share * (light_from(n) + light_from(-n)) + 0.5 * sunlight * abs(dot(n, view.light_direction.xyz)) / pi;
  return vec4(light * hidden, hidden);
}

// Sky above, ground below, as a face of a crack mirrors them.
vec3 mirrored(vec3 way) {
  return mix(view.ground_irradiance.rgb / pi, sky_radiance(vec3(way.xy, max(way.z, 0.02))), smoothstep(-0.1, 0.1, way.z));
}

vec4 crack(vec3 eye, vec3 n, vec3 place) {
  float share = ice.origin.w;
  vec3 sunlight = view.light_irradiance.rgb * share;
  // A crack is a third as wide as its strip, and covers of a pixel what it covers.
  float off = 3.0 * abs(place.y), soft = max(3.0 * fwidth(place.y), 1e-4);
  if (place.z > 0.5) {
    // Crushed: grains of glass, close in the middle, ragged outwards; each shows another piece of what lies around.
    float out_of_middle = place.z - 1.0;
    vec2 grain = random_place(floor(place.xy / 0.0014));
    float hidden = clamp(1.5 - out_of_middle - 0.9 * grain.x, 0.0, 1.0) * 0.9;
    vec3 light = (0.25 + 1.5 * grain.y * grain.y) * share * (light_from(n) + light_from(-n)) +
                 grain.y * sunlight * abs(dot(n, view.light_direction.xyz)) / pi;
    return vec4(light * hidden, hidden);
  }
  // As the cracks of ice: a face that light of both sides is mirrored in, wholly where it is met at a flat angle; its unevenness turns it about.
  n = normalize(n + 0.25 * vec3(cos(place.x * 61.0), sin(place.x * 47.0), cos(place.x * 83.0 + 1.0)));
  n *= -sign(dot(n, eye) + 1e-6);
  vec3 h = normalize(view.light_direction.xyz - eye);
  float shine = pow(abs(dot(n, h)), 40.0) * (40.0 * 1.5 / 220.0);
  float touches = smoothstep(0.15, 0.5, textureLod(noise, vec2(place.x * 3.0, 0.0) + n.xy, 0.0).r);
  float hidden = clamp((1.0 - off) / soft + 0.5, 0.0, 1.0) * min(1.0, 2.0 / soft) * mix(0.4, 0.95, touches);
  vec3 light = 1.15 * mirrored(reflect(eye, n)) * share + sunlight * shine;
  return vec4(light * hidden, hidden);
}

void main() {
  vec3 eye = normalize(relative);
  vec4 lies = cracked != 0 ? crack(eye, normalize(normal), rest) : frost(eye, normalize(normal), rest);
  float fog = 1.0 - exp2(-length(relative) * view.sky_irradiance.w);
  result = vec4(mix(lies.rgb, fog_radiance(eye) * lies.a, fog), lies.a);
}
