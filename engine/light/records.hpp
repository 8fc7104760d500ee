#ifndef SEPTET_LIGHT_RECORDS_HPP
#define SEPTET_LIGHT_RECORDS_HPP
/// Records that passes send to their shaders, of storage or of push constants: see the pass of the same name in engine/render/passes.
///
/// Each consists of vec4 and mat4 alone, with no room between them: so C++, std140, std430 and push constants lay a record out alike, which LIGHT_RECORD asserts.
/// Places are relative to the eye along the world's axes, m.

#include "engine/light/language.hpp"

LIGHT_BEGIN

/// A body that hides the sky from the ground below it.
struct ContactRecord {
  vec4 middle;  ///< On the ground; height of the body, m.
  vec4 ahead;   ///< Unit; half its length, m.
  vec4 aside;   ///< Unit; half its width, m.
  vec4 light;   ///< Clearance below it, m; share of the sky.
};
LIGHT_RECORD(ContactRecord, light, 4)

/// A lamp's glow: a square that faces the viewer.
struct GlowRecord {
  vec4 position_size;  ///< Place; radius, m.
  vec4 color;          ///< Radiance at its middle.
};
LIGHT_RECORD(GlowRecord, color, 2)

/// A lamp that a wet road mirrors: a strip of the road between the lamp's foot and the eye's.
struct WetLampRecord {
  vec4 position_size;  ///< Place; radius of the lens, m.
  vec4 energy_road;    ///< Radiance times area of what is mirrored; height of the road below the lamp, m.
};
LIGHT_RECORD(WetLampRecord, energy_road, 2)

/// A puff of smoke: a square that faces the viewer.
struct PuffRecord {
  vec4 position_radius;  ///< Place; standard deviation of its density, m.
  vec4 radiance_depth;   ///< Light that it scatters and gives off; optical depth through its middle.
  vec4 turn;             ///< x: where in the noise its pattern lies.
};
LIGHT_RECORD(PuffRecord, turn, 3)

/// A drop's streak, turned to the eye about its length.
struct StreakRecord {
  vec4 from_width;     ///< Place; width, m.
  vec4 along_opacity;  ///< To its end, m; opacity.
  vec4 radiance;
};
LIGHT_RECORD(StreakRecord, radiance, 3)

/// A corner of a mirror's glass.
struct GlassRecord {
  vec4 position;  ///< Place; reflectance.
  vec4 at;        ///< xy: in the picture of all mirrors, pixels.
};
LIGHT_RECORD(GlassRecord, at, 2)

/// A box, a line of text or a mirror's frame over the picture.
struct QuadConstants {
  vec4 ndc;    ///< Left, top, right, bottom.
  vec4 uv;     ///< The same in the atlas; of a frame, pixels from its middle.
  vec4 color;  ///< sRGB, premultiplied.
  vec4 kind;   ///< x: 1 text, 0 a box, 2 a frame; of that y: its width, z: its corners' outer radius, pixels.
};
LIGHT_RECORD(QuadConstants, kind, 4)

/// The shadow cascade that is drawn.
struct CascadeConstants {
  mat4 clip_from_relative;
  /// xy: number of its corner's texel over the world: a pattern that came along with the eye would crawl.
  vec4 first_texel;
};
LIGHT_RECORD(CascadeConstants, first_texel, 5)

/// From a frame's pixels to those of the frame before.
struct ReprojectionConstants {
  mat4 before_from_now;  ///< Clip coordinates.
  vec4 viewport;         ///< Left, top, width, height, pixels.
  /// x: from radiance to the tone curve. y: 1 where there is a frame before. zw: shift of still surfaces, pixels.
  vec4 more;
};
LIGHT_RECORD(ReprojectionConstants, more, 6)

/// The material of one draw.
struct MaterialConstants {
  vec4 base_color;  ///< rgb, opacity.
  vec4 emission;    ///< rgb, roughness.
  vec4 surface;     ///< Metallic, reflectance at normal incidence, clear coat, takes paint.
  vec4 light;  ///< Share of the sky that the surface sees, retroreflection cd/(lx m²), columns and rows of pictures.
  vec4 more;   ///< Share of light from around, lit by night.
};
LIGHT_RECORD(MaterialConstants, more, 5)

/// One body of ice. It has a rectangle in the images of its layers, seen through a frustum that is fitted to it; that depends on the eye and the
/// body alone, so that two screens see the same.
struct IceConstants {
  vec4 u;           ///< xyz: place in the layers across, times the distance along forward. w: slope of the bumps.
  vec4 v;           ///< xyz: the same downwards. w: waves per metre.
  vec4 forward;     ///< xyz: unit, from the eye to the body. w: nearest distance along it.
  vec4 origin;      ///< xyz: of the body. w: share of the sun's light that reaches it.
  vec4 blend;       ///< x: share of the front face's normal, y: of the back face's, signed. z: frost, w: 1 it reflects.
  vec4 absorption;  ///< rgb: per metre. w: the body's largest extent, m.
  vec4 rectangle;   ///< In the layers, texels: first and last corner.
  /// Of the bodies behind it. x: length over which light is followed, m; 0: not. y: their largest extent, m. z: behind their far end. w: exponent
  /// of the highlight.
  vec4 beyond;
};
LIGHT_RECORD(IceConstants, beyond, 8)

LIGHT_END

#endif
