#ifndef SEPTET_TESTS_EVERY_FUNCTION_HPP
#define SEPTET_TESTS_EVERY_FUNCTION_HPP
/// Every function of engine/light at one point of its arguments, in the language that these are written in: the same
/// text runs on the device and on the host. A new function gets its case here, and `function_count` grows by one.

#include "engine/light/beacon.hpp"
#include "engine/light/beam.hpp"
#include "engine/light/clouds.hpp"
#include "engine/light/crack.hpp"
#include "engine/light/fresnel.hpp"
#include "engine/light/frost.hpp"
#include "engine/light/ice_optics.hpp"
#include "engine/light/lamplight.hpp"
#include "engine/light/language.hpp"
#include "engine/light/microfacets.hpp"
#include "engine/light/puff.hpp"
#include "engine/light/ruts.hpp"
#include "engine/light/sky_irradiance.hpp"
#include "engine/light/sky_tables.hpp"
#include "engine/light/smoke_shade.hpp"
#include "engine/light/snow.hpp"
#include "engine/light/soot.hpp"
#include "engine/light/surface_maps.hpp"
#include "engine/light/tone_curve.hpp"
#include "engine/light/wet_road.hpp"

LIGHT_BEGIN

LIGHT_CONST uint function_count = 56u;

/// A unit vector from two numbers of 0 to 1.
LIGHT_FN vec3 direction_of(float height, float turn) {
  const float z = 2.0f * height - 1.0f, level = sqrt(max(0.0f, 1.0f - z * z));
  return vec3(level * cos(2.0f * pi * turn), level * sin(2.0f * pi * turn), z);
}

/// `a` and `b`: numbers of 0 to 1, of which each function's arguments are made.
LIGHT_FN vec4 value_of(uint function, vec4 a, vec4 b) {
  const vec3 one = direction_of(a.x, a.y), other = direction_of(a.z, a.w);
  // A lamp that points about ahead, and a way from it within its beam.
  const vec3 level = normalize(vec3(1.0f, 0.1f * a.x - 0.05f, 0.1f * a.y - 0.05f));
  const vec3 way = normalize(vec3(1.0f, 1.6f * a.z - 0.8f, 0.4f * a.w - 0.3f));
  const ivec3 cell = ivec3(int(8.0f * a.x), int(8.0f * a.y), int(8.0f * a.z));
  const FeatherPlace feather = feather_at(vec2(a.x, a.y));
  switch (function) {
    case 0u:
      return vec4(dipped_share(level, way, 1.0f + b.x));
    case 1u:
      return vec4(beam_share(level, way, b.x, 1.0f + b.y));
    case 2u:
      return vec4(beam_share(one, other, b.x, 1.0f + b.y));
    case 3u:
      return vec4(beam_facing(a.x));
    case 4u:
      return vec4(beam_returned(0.01f * a.x * a.y));
    case 5u:
      return vec4(display_code(8.0f * vec3(a.x, a.y, a.z) - 0.5f), 0.0f);
    case 6u:
      return vec4(from_rut(a.x));
    case 7u:
      return vec4(rut_at(a.x));
    case 8u:
      return vec4(puddle_share(a.x));
    case 9u:
      return vec4(puddle_at(a.x, a.y, 0.25f * a.z));
    case 10u:
      return vec4(wet_albedo(vec3(a.x, a.y, a.z), b.x, b.y), 0.0f);
    case 11u:
      return vec4(water_covers(a.x, a.y));
    case 12u:
      return vec4(water_roughness(a.x));
    case 13u:
      return vec4(wet_beads_return(a.x));
    case 14u:
      return vec4(holds_snow(2.0f * a.x - 1.0f));
    case 15u:
      return vec4(twigs_hold_snow(2.0f * a.x - 1.0f));
    case 16u:
      return vec4(snow_beside_ruts(a.x));
    case 17u:
      return vec4(withered(vec3(a.x, a.y, a.z), a.w), 0.0f);
    case 18u:
      return vec4(snowy_albedo(vec3(a.x, a.y, a.z), a.w), 0.0f);
    case 19u:
      return vec4(in_soot(cell, ivec3(int(9.0f * b.x), 6, 7)) ? 1.0f : 0.0f);
    case 20u:
      return vec4(float(soot_index(cell, ivec3(8, 6, 7))));
    case 21u:
      return vec4(soot_weight(vec3(a.x, a.y, a.z), soot_corner(int(8.0f * a.w))));
    case 22u:
      return vec4(fifth_power(a.x));
    case 23u:
      return vec4(schlick(vec3(a.x, a.y, a.z), b.x), 0.0f);
    case 24u:
      return vec4(fresnel(a.x, into_ice), fresnel(a.x, out_of_ice), fresnel(a.x, 0.5f + b.x), 0.0f);
    case 25u:
      return vec4(blended_normal(one, other, 1.0f - paper_back_share, -paper_back_share), 0.0f);
    case 26u:
      return vec4(refracted(one, dot(one, other) > 0.0f ? -other : other, into_ice), 0.0f);
    case 27u:
      return vec4(refracted(one, dot(one, other) > 0.0f ? -other : other, out_of_ice), 0.0f);
    case 28u:
      return vec4(mirrored_way(one, other), 0.0f);
    case 29u:
      return vec4(paper_fresnel(a.x));
    case 30u:
      return vec4(transmittance(clear_ice_absorption_per_m, 30.0f * a.x), 0.0f);
    case 31u:
      return vec4(ggx_density(a.x, 0.01f + a.y));
    case 32u:
      return vec4(cloud_place(vec3(one.x, one.y, abs(one.z)), 9000.0f * vec2(b.x, b.y)), 0.0f, 0.0f);
    case 33u:
      return vec4(cloud_sunward(vec2(a.x, a.y), one), 0.0f, 0.0f);
    case 34u:
      return vec4(cloud_density(a.x, a.y));
    case 35u:
      return vec4(cloud_radiance(a.x, a.y, 2.0f * a.z - 1.0f, vec3(b.x, b.y, b.z), vec3(b.y, b.z, b.w)), 0.0f);
    case 36u:
      return vec4(cloud_hides(a.x, a.y, a.z));
    case 37u:
      return vec4(random_place(floor(1000.0f * vec2(a.x - 0.5f, a.y - 0.5f))), 0.0f, 0.0f);
    case 38u:
      return vec4(feather.along, feather.aside, feather.seam, 0.0f);
    case 39u:
      return vec4(feather_mass(feather, b.x, b.y, b.z));
    case 40u:
      return vec4(frost_hides(a.x, 0.2f * a.y), frost_hides_on_average(a.x, 0.1f + a.y, 0.2f * a.z), 0.0f, 0.0f);
    case 41u:
      return vec4(crushed_grain(vec2(a.x, a.y)), crushed_hides(vec2(a.x, a.y), 1.0f + a.z), crack_hides(a.w));
    case 42u:
      return vec4(uneven_crack(one, b.x), 0.0f);
    case 43u:
      return vec4(crack_noise_place(one, b.x), 0.0f, 0.0f);
    case 44u:
      return vec4(from_all_sides(vec4(0.5f * one, 4.0f * a.w - 2.0f)));
    case 45u:
      return vec4(lamplight(one, b.x, other));
    case 46u:
      return vec4(roofed_between(a.x, a.y));
    case 47u:
      return vec4(sky_table_of(a.x));
    case 48u: {  // Terms are set one by one: neither language has the other's list.
      vec3 terms[irradiance_terms];
      terms[0] = vec3(a.x);
      terms[1] = vec3(a.y, a.z, a.w);
      terms[2] = one;
      terms[3] = 0.3f * other;
      terms[4] = vec3(b.x, b.y, b.z);
      terms[5] = 0.3f * one;
      terms[6] = 0.1f * other;
      return vec4(irradiance_on(terms, normalize(vec2(b.y + 0.1f, b.z)), direction_of(b.w, a.x)), 0.0f);
    }
    case 49u:
      return vec4(lamp_spread_m2(a.x));
    case 50u:
      return vec4(beacon_share(one, normalize(vec2(b.x - 0.5f, 0.6f * b.y + 0.1f))));
    case 51u:
      return vec4(beacon_irradiance((1.0f + 3.0f * b.z) * one, other, normalize(vec2(b.x - 0.5f, 0.6f * b.y + 0.1f))));
    case 52u:
      return vec4(puff_falloff(a.x), puff_density(9.0f * a.y), puff_depth(a.z, 0.1f + a.w), puff_billows(b.x, b.y));
    case 53u:
      return vec4(puff_passes(a.x, a.y), puff_half_side(a.z), puff_shown(3.0f * a.w),
                  puff_scatters(vec3(b.x), vec3(b.y)).x);
    case 54u:
      return vec4(mapped_normal(vec3(b.x, b.y, b.z), one, other, direction_of(b.w, a.x)), 0.0f);
    case 55u:
      return vec4(normal_share(8.0f * a.x - 4.0f),
                  below_smoke(3.0f * a.y * vec3(1.0f, a.z, a.z * a.z + 0.1f + a.w), 4.0f * b.x - 2.0f),
                  smoke_above(3.0f * a.y * vec3(1.0f, a.z, a.z * a.z + 0.1f + a.w), 4.0f * b.x - 2.0f),
                  sun_within_smoke(3.0f * b.y, 3.0f * b.z + 0.1f, b.w) + around_within_smoke(3.0f * b.y, b.w));
    default:
      return vec4(0.0f);
  }
}

LIGHT_END

#endif
