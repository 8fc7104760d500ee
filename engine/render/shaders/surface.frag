#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"
#include "material.glsl"
#include "sunlit.glsl"
#include "smoke_shade.glsl"
#include "lamplight.glsl"
#include "wet_road.glsl"
#include "fade.glsl"
#include "engine/light/beacon.hpp"
#include "engine/light/beam.hpp"
#include "engine/light/microfacets.hpp"
#include "engine/light/ruts.hpp"
#include "engine/light/snow.hpp"
#include "engine/light/soot.hpp"
#include "engine/light/surface_maps.hpp"

// Rare cases are specialised away: a software rasteriser runs both sides of a branch.
//
// `textured`: 1 one sample, 2 three along the longer side of the pixel's footprint.
layout(constant_id = 0) const uint textured = 0;
layout(constant_id = 1) const uint cut = 0;       // Alpha cuts holes, both sides are drawn: 1 by coverage, 2 by pixels.
// Reflects sun and sky: 1 by its own layer, 2 by a clear coat, 3 by both.
layout(constant_id = 2) const uint glossy = 0;
layout(constant_id = 3) const uint blended = 0;
// Bits: 1 headlights, 2 standing lamps, 4 the main beam of some headlights, 8 beacons.
layout(constant_id = 4) const uint lamps = 0;
layout(constant_id = 5) const uint snowy = 0;
layout(constant_id = 6) const uint sooty = 0;
// Covers a share of its pixels; drawn wider than it is if thinner than a pixel.
layout(constant_id = 7) const uint stripe = 0;
layout(constant_id = 8) const uint road = 0;            // Gets wet, and carries the tracks of wheels.
layout(constant_id = 9) const uint mirror_of_road = 0;  // Drawn for a wet road's mirror image.
layout(constant_id = 10) const uint fading = 0;         // Some pixels show another level of detail.

layout(constant_id = 11) const uint retroreflective = 0;
layout(constant_id = 16) const uint two_sided = 0;  // Not cut, and lit from both sides.
layout(constant_id = 17) const uint in_street = 0;  // A wall along a street, between houses.
layout(constant_id = 12) const uint over_frames = 0;  // See surface.vert.
// Images of the material beside that of its base colour (scene::SurfaceMap). Bits: 1 emission, 2 properties, 4 normal.
layout(constant_id = 18) const uint maps = 0;
// Images that hold square roots of linear light, others hold linear numbers. Bits: 1 base colour, 2, 4, 8 the maps.
layout(constant_id = 19) const uint square_roots = 1;
// Maps that lie by the second coordinates, by the same bits as `maps`.
layout(constant_id = 20) const uint by_second_uv = 0;
layout(constant_id = 21) const uint in_smoke_shade = 0;  // Smoke lies before the sun or moon.
layout(set = 0, binding = 21) uniform sampler2D emission_map;
layout(set = 0, binding = 22) uniform sampler2D properties_map;
layout(set = 0, binding = 23) uniform sampler2D normal_map;

vec4 in_linear(vec4 texel, uint bit) { return (square_roots & bit) != 0 ? decoded(texel) : texel; }

const vec3 under_roof = vec3(0.15, 0.13, 0.10);  // Radiance of the surroundings reflected in tunnels.

layout(location = 0) in vec3 relative;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 color;
layout(location = 4) flat in vec4 emission;
layout(location = 5) in vec3 fog_light;
layout(location = 6) flat in float snowed;
layout(location = 7) flat in vec2 shown;
layout(location = 8) in vec2 second_uv;
layout(location = 9) in vec4 tangent;
layout(location = 0) out vec4 result;

vec2 uv_of(uint map) { return (by_second_uv & map) != 0 ? second_uv : uv; }

layout(set = 0, binding = 1, std430) readonly buffer Soot { uint soot[]; };  // Four cells each.

float soot_in(ivec3 cell, ivec3 size) {
  int at = soot_index(cell, size);
  return float((soot[at >> 2] >> ((at & 3) * 8)) & 255u) / 255.0;
}

// Share of a surface's light that its soot absorbs, interpolated between the eight cells around.
float soot_cover() {
  vec4 place = vec4(relative, 1.0);
  vec3 at = vec3(dot(view.soot_x, place), dot(view.soot_y, place), dot(view.soot_z, place));
  ivec3 size = ivec3(view.soot_size.xyz), low = ivec3(floor(at));
  if (!in_soot(low, size)) return 0.0;
  vec3 share = at - vec3(low);
  float sum = 0.0;
  for (int n = 0; n < 8; ++n) sum += soot_weight(share, soot_corner(n)) * soot_in(low + soot_corner(n), size);
  return sum;
}

// Road at a grazing angle, with a long footprint of the pixel: three samples along it, from a finer mip level.
vec4 along_footprint(vec2 at) {
  vec2 across = dFdx(at), down = dFdy(at);
  float a = dot(across, across), d = dot(down, down);
  float bias = -clamp(0.5 * log2(max(a, d) / max(min(a, d), 1e-12)), 0.0, 1.7);
  vec2 step = 0.333 * (a > d ? across : down);
  return (texture(image, at - step, bias) + texture(image, at, bias) + texture(image, at + step, bias)) / 3.0;
}

// Share of a pixel's width that a stripe covers (box filter), `at` metres from the middle of its `half_width`.
float on_stripe(float at, float half_width) {
  float breadth = max(length(vec2(dFdx(at), dFdy(at))), 1e-5);
  vec2 ends = clamp(at + vec2(0.5, -0.5) * breadth, -half_width, half_width);
  return (ends.x - ends.y) / breadth;
}

// Light from all headlights that reach a place, instead of the nearest ten: for graphics cards.
layout(constant_id = 14) const uint clustered_headlights = 0;
layout(set = 0, binding = 16, std430) readonly buffer Clusters { uint clusters[]; };  // See passes/light_clusters.hpp.

vec4 of_cluster(uint at) { return uintBitsToFloat(uvec4(clusters[at], clusters[at + 1], clusters[at + 2], clusters[at + 3])); }

// Irradiance from one Headlight, a lamp or a pair; w as below.
vec4 headlight(vec4 position, vec4 direction, vec3 n) {
  vec3 to_surface = relative - position.xyz;
  float square = dot(to_surface, to_surface);
  vec3 ray = to_surface * inversesqrt(square);
  float spread_m2 = lamp_spread_m2(square);
  float share = (lamps & 4) != 0 ? beam_share(direction.xyz, ray, direction.w, spread_m2) : dipped_share(direction.xyz, ray, spread_m2);
  float light = position.w * share;
  vec3 lit = headlight_color * beam_facing(max(0.0, -dot(n, ray)));
  if (retroreflective == 0) return vec4(light * lit, 0.0);
  float back = 1.0 - dot(ray, normalize(relative));  // Half the square of the angle between lamp and eye.
  return light * vec4(lit, beam_returned(back));
}

// Irradiance from headlights; w: light that retroreflectors return to the eye from lamps beside it, per unit of
// retroreflection, as lx.
vec4 headlights(vec3 n) {
  vec4 sum = vec4(0.0);
  if (clustered_headlights != 0) {
    const int side = 24;
    ivec2 square = ivec2(floor(relative.xy / 20.0 + 0.5 * float(side)));
    if (any(lessThan(square, ivec2(0))) || any(greaterThanEqual(square, ivec2(side)))) return sum;
    uint at = uint(square.y * side + square.x);
    for (uint i = clusters[at]; i < clusters[at + 1]; ++i)
      sum += headlight(of_cluster(clusters[i]), of_cluster(clusters[i] + 4), n);
    return sum;
  }
  for (int i = 0; i < int(view.wind.z); ++i) sum += headlight(view.headlight_position[i], view.headlight_direction[i], n);
  return sum;
}

// Irradiance from beacons.
vec3 beacons(vec3 n) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < int(view.soot_size.w); ++i) {
    vec4 place = view.beacon_position[i], light = view.beacon_intensity[i];
    sum += light.rgb * beacon_irradiance(place.xyz - relative, n, vec2(place.w, light.w));
  }
  return sum;
}

// Sun's highlight on microfacets (GGX, with Kelemen's visibility 1/(4·vh²)), per unit of irradiance on them.
vec3 shine(vec3 facet, vec3 to_eye, vec3 f0, float roughness) {
  vec3 h = normalize(view.light_direction.xyz + to_eye);
  float vh = max(dot(to_eye, h), 1e-3), density = ggx_density(max(dot(facet, h), 0.0), roughness * roughness);
  return min(schlick(f0, vh) * (density * 0.25 / (vh * vh)), vec3(40.0));
}

// Share of an even sky that a layer reflects: a fit to GGX with Smith's masking and Schlick's Fresnel, within 0.03 for
// roughness up to 0.7.
vec3 layer_reflectance(float cosine, vec3 f0, float roughness) {
  return f0 * (1.0 - 0.15 * roughness) + (1.0 - f0) * (fifth_power(1.0 - cosine) / (1.0 + 20.0 * roughness * roughness * roughness));
}

// Normal of the material's map. How the place moves along u and v is the vertices' own, or else follows from
// neighbouring pixels.
vec3 normal_in_map(vec3 n) {
  vec2 at = uv_of(4);
  vec3 across = dFdx(relative), down = dFdy(relative);
  vec2 uv_across = dFdx(at), uv_down = dFdy(at);
  float side = uv_across.x * uv_down.y < uv_down.x * uv_across.y ? -1.0 : 1.0;
  vec3 along_u = side * (across * uv_down.y - down * uv_across.y), along_v = side * (down * uv_across.x - across * uv_down.x);
  if (tangent.w != 0.0) {
    along_u = tangent.xyz;
    along_v = cross(n, along_u) * -tangent.w;
  }
  return mapped_normal(in_linear(texture(normal_map, at), 8).rgb, n, along_u, along_v);
}

void main() {
  if (fading != 0 && !is_shown(shown, gl_FragCoord.xy)) discard;
  // Static surfaces below the road are not mirrored by it.
  if (mirror_of_road != 0 && snowed > 0.5 && dot(view.road.xyz, relative) < view.road.w) discard;
  vec4 base = color;
  // Signs and plates take a finer mip level for sharper writing; their plain pictures do not flicker by it.
  if (textured == 1) base *= in_linear(texture(image, uv, retroreflective != 0 ? -0.7 : 0.0), 1);
  if (textured == 2) base *= in_linear(along_footprint(uv), 1);
  float alpha = base.a;
  if (stripe != 0) alpha *= on_stripe(uv.x, uv.y);
  if (cut == 2 && alpha < 0.5) discard;
  if (cut == 1) {
    // Sharpened so that the edge is a pixel wide at any mip level; coverage of the samples follows from it.
    alpha = clamp((base.a - 0.5) / max(fwidth(base.a), 1e-3) + 0.5, 0.0, 1.0);
    if (alpha < 0.05) discard;
  }
  vec3 n = normalize(normal);
  if ((maps & 4) != 0) n = normal_in_map(n);
  if ((cut != 0 || two_sided != 0) && !gl_FrontFacing) n = -n;
  float distance_m = length(relative);
  vec3 to_eye = -relative / distance_m;
  vec3 albedo = base.rgb;
  float roughness = material.emission.w, metallic = material.surface.x, from_around = material.more.x;
  if ((maps & 2) != 0) {
    vec3 properties = in_linear(texture(properties_map, uv_of(2)), 4).rgb;
    from_around *= properties.r;
    roughness = max(least_mapped_roughness, roughness * properties.g);
    metallic *= properties.b;
  }
  float share_of_sky = emission.w;

  float snow_lies = 0.0;
  if (snowy != 0) {
    float snow = cut != 0 ? twigs_hold_snow(n.z) : holds_snow(n.z);
    if (cut != 0) albedo = withered(albedo, view.weather.y);
    if (road != 0 && textured != 0) snow *= snow_beside_ruts(uv.x);
    snow_lies = view.weather.y * share_of_sky * snow * snowed;
    albedo = snowy_albedo(albedo, snow_lies);
  }
  float wet = 0.0, under_water = 0.0;
  vec2 slope = vec2(0.0);
  if (glossy != 0 && road != 0) {
    wet = view.weather.x * share_of_sky * (1.0 - snow_lies);
    vec2 ground = relative.xy + view.water.xy;
    vec2 across = dFdx(ground), down = dFdy(ground);
    float footprint_m = sqrt(max(dot(across, across), dot(down, down)));
    under_water = puddle(ground, footprint_m, textured != 0 ? rut_at(uv.x) : 0.0, wet);
    slope = under_water * ripple_slope(relative.xy, footprint_m);
    albedo = wet_albedo(albedo, wet, under_water);
  }

  vec3 to_light = view.light_direction.xyz;
  float facing = dot(n, to_light);
  float lit = share_of_sky;
  lit *= sunlit(relative, n, abs(facing));
  if (in_smoke_shade != 0) lit *= left_by_smoke(relative);
  float diffuse = max(facing, 0.0);
  if (cut != 0) diffuse = 0.75 * diffuse + 0.25 * abs(facing) + 0.1;  // Leaves let light through.
  vec3 sunlight = view.light_irradiance.rgb * lit;
  vec3 surroundings = in_street != 0 ? street_irradiance_on(n) : irradiance_on(n);
  // Roads lie level, in the open.
  vec3 ambient = road != 0 ? view.sky_irradiance.rgb * share_of_sky : surroundings * (share_of_sky * from_around);
  // Light of the lamps of a roofed place: from all sides, and near the eye their pools as well.
  float between_pools = 1.0 - share_of_sky;
  if ((lamps & 2) != 0) {
    vec4 thrown = standing_lamps(relative, n, share_of_sky);
    // Ceilings above the lamps get only the light that the road returns.
    between_pools *= (1.0 - 0.7 * thrown.w) * (1.0 + 0.75 * thrown.w * min(n.z, 0.0));
    ambient += thrown.rgb * from_around;
  }
  ambient += irradiance_between_pools * between_pools;
  if ((lamps & 8) != 0) ambient += beacons(n);
  vec3 irradiance = sunlight * diffuse + ambient;
  vec3 radiance = albedo * (1.0 - metallic) / pi;
  if ((lamps & 1) != 0) {
    vec4 beams = headlights(n);
    irradiance += beams.rgb;
    radiance *= irradiance;
    if (retroreflective != 0)
      radiance += base.rgb * min(material.light.y * beams.w * (stripe != 0 ? wet_beads_return(wet) : 1.0), 2.0 * view.light_irradiance.w);
  } else {
    radiance *= irradiance;
  }

  if (glossy != 0 && road != 0) {
    // Film of water on the road.
    float r = water_roughness(under_water);
    vec3 facet = normalize(n - vec3(slope, 0.0));
    float cosine = clamp(dot(facet, to_eye), 0.0, 1.0);
    float fresnel = water_reflectance + (1.0 - water_reflectance - r) * fifth_power(1.0 - cosine);
    vec3 mirrored = reflect(-to_eye, facet);
    vec3 around = sky_radiance(normalize(vec3(mirrored.xy, max(mirrored.z, 0.02)))) * share_of_sky + under_roof * (1.0 - share_of_sky);
    vec4 near_by = mirrored_on_road(normalize(relative.xy), slope, under_water);
    around = around * (1.0 - near_by.a) + near_by.rgb;
    radiance += fresnel * around * water_covers(wet, under_water);
    radiance += shine(facet, to_eye, vec3(water_reflectance), r) * sunlight * (max(facing, 0.0) * wet);
  } else if (glossy != 0) {
    // Light reflected by a layer does not reach the one below it, on its way in as on its way out.
    float cosine = clamp(dot(n, to_eye), 0.0, 1.0);
    vec3 mirrored = reflect(-to_eye, n), beam = sunlight * max(facing, 0.0), roof = under_roof * (1.0 - share_of_sky);
    share_of_sky *= from_around;
    if ((glossy & 1) != 0) {
      vec3 f0 = mix(vec3(material.surface.y), albedo, metallic), fresnel = layer_reflectance(cosine, f0, roughness);
      radiance = radiance * (1.0 - fresnel) * 0.92 + fresnel * (mirrored_sky(mirrored, roughness) * share_of_sky + roof) +
                 shine(n, to_eye, f0, roughness) * beam;
      if (blended != 0 && stripe == 0) alpha = clamp(alpha + dot(fresnel, vec3(0.33)), 0.0, 1.0);
    }
    if ((glossy & 2) != 0) {
      float coat = material.surface.z, fresnel = coat * layer_reflectance(cosine, vec3(coat_reflectance), coat_roughness).r;
      radiance = radiance * ((1.0 - fresnel) * (1.0 - 0.08 * coat)) + fresnel * (mirrored_sky(mirrored, coat_roughness) * share_of_sky + roof) +
                 coat * shine(n, to_eye, vec3(coat_reflectance), coat_roughness) * beam;
    }
  }
  vec3 shining = vec3(1.0);
  if ((maps & 1) != 0) shining = in_linear(texture(emission_map, uv_of(1)), 2).rgb;
  radiance += emission.rgb * shining * view.light_irradiance.w;
  if (sooty != 0) radiance *= 1.0 - soot_cover();

  float fog = 1.0 - exp2(-distance_m * view.sky_irradiance.w);
  radiance = mix(radiance, fog_light, fog);
  if (mirror_of_road != 0) alpha = 1.0;
  result = vec4(radiance, alpha);
  if (blended != 0) result.rgb *= alpha;
  if (over_frames != 0 && blended == 0 && mirror_of_road == 0) result.a = over_frames == 2 ? 1.0 : 0.0;
}
