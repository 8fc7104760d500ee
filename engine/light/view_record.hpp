#ifndef SEPTET_LIGHT_VIEW_RECORD_HPP
#define SEPTET_LIGHT_VIEW_RECORD_HPP
/// Record that every pass of a view reads. Positions are relative to the eye, along the world's axes, metres. Radiance: see engine/instant/atmosphere.hpp.
///
/// Laid out alike by C++ and std140, as the records of records.hpp are.

#include "engine/light/language.hpp"
#include "engine/light/sky_irradiance.hpp"

LIGHT_BEGIN

LIGHT_CONST int most_headlights = 10;
LIGHT_CONST int most_beacons = 4;

struct ViewUniforms {
  mat4 clip_from_relative;
  mat4 shadow_from_relative;             ///< To texture coordinates and depth of the near cascade.
  vec4 far_from_near;                    ///< Texture coordinates of the far cascade: xy·near + zw.
  vec4 light_direction;                  ///< xyz: to the sun or moon. w: side of a near cascade's texel, m.
  vec4 light_irradiance;                 ///< rgb. w: share of their radiance with which lamps glare.
  vec4 sky_irradiance;                   ///< rgb. w: halvings by the air per metre.
  vec4 ground_irradiance;                ///< rgb. w: night, 0 to 1.
  vec4 sun_direction;                    ///< xyz. w: side of a far cascade's texel, m.
  vec4 sun_level;                        ///< xy: the sun's direction on the level, unit. z: overcast, w: cloud cover.
  vec4 irradiance[irradiance_terms];     ///< rgb. [0].w: height of the lamps under roofs, m.
  vec4 ray_middle, ray_right, ray_down;  ///< Direction to a pixel: middle + right·x + down·y in NDC.
  vec4 billboard_right, billboard_up;    ///< xyz: the screen's axes. right.w: radians a pixel.
  vec4 weather;                          ///< Wetness, snow cover, simulated time s, rain mm/h.
  vec4 wind;  ///< xy: drift of the clouds, m. z: number of headlights. w: share of the sky where the eye is.
  vec4 headlight_position[most_headlights];   ///< xyz relative. w: intensity.
  vec4 headlight_direction[most_headlights];  ///< xyz unit. w: main beam, 0 to 1.
  vec4 soot_x, soot_y, soot_z;                ///< Rows from relative places to cells of the soot.
  vec4 soot_size;                             ///< xyz: cells. w: number of beacons.
  vec4 smoke_shade_x, smoke_shade_y;          ///< Rows from relative places to texels of the shade of smoke.
  vec4 smoke_shade_height;                    ///< The same to its heights, m.
  /// From relative places to the field's coordinates: xy·z + xy. w: strength of lamps in the open.
  vec4 lamp_field;
  vec4 lamp_hue;  ///< rgb. w: strength of lamps under roofs.
  vec4 road;      ///< xyz: normal of the road near the eye, w: its height along that from the eye.
  /// xy: the eye within a tile of puddles, m. z: 1 where mirror_image holds this view, w: 1 where ripples hold rain.
  vec4 water;
  /// xy: a pixel as a share of the target's width and height. zw: the eye within a tile of ripples, tiles.
  vec4 target;
  /// xy: offset of the samples of still surfaces, NDC. z: share of its depth that one keeps. w: 1 where the sun or moon casts visible shadows.
  vec4 offset;
  /// rgb: as `irradiance`, of walls along a street.
  vec4 street_irradiance[irradiance_terms];
  vec4 beacon_position[most_beacons];   ///< xyz relative. w: the vehicle's ahead on the level, x.
  vec4 beacon_intensity[most_beacons];  ///< rgb, on the level. w: that ahead, y.
};
LIGHT_RECORD(ViewUniforms, beacon_intensity, 4 * 2 + 27 + 2 * irradiance_terms + 2 * most_headlights + 2 * most_beacons)

LIGHT_END

#endif
