#pragma once
/// Light of standing lamps (instant/standing_lamps.hpp) on the ground around the eye, as a picture from above: one
/// sample a pixel for any number of lamps.
///
/// A texel holds the sum of the light that arrives at the ground: xyz, a vector toward its source (the irradiance of a
/// surface is its dot product with the normal); w, the sum regardless of direction, negative for lamps under a roof.
/// The field is 384 m wide and is made anew only when the eye has moved on by 48 m, at places of a fixed grid, so that
/// it depends on the eye's place and not on its path.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/instant/standing_lamps.hpp"

namespace septet::render {

using instant::StandingLamp;

struct LampField {
  static constexpr std::uint32_t side = 256;
  static constexpr double texel_m = 1.5, step_m = 48.0;
  Vec2 corner_m{0.0};                 ///< World position of the corner of texel (0, 0).
  bool open = false, roofed = false;  ///< Presence of lamps in the open, of lamps under roofs.
  glm::vec3 hue{1.0f};                ///< Colour of the lamps, of luminance 1.
  float roofed_height_m = 5.0f;       ///< Mean height of lamps under roofs.
  std::vector<glm::vec4> texels;      ///< Rows to the north; empty without lamps.

  /// True if any lamp gives light. `street_lamps`: share to which street lamps are lit (0 to 1).
  bool shine(float street_lamps) const { return roofed || (open && street_lamps > 0.0f); }
};

/// Corner of the field around an eye.
Vec2 lamp_field_corner(const Vec3& eye_m);
LampField lamp_field(std::span<const StandingLamp> lamps, const Vec2& corner_m);

/// Packs the texels as half floats for the device.
std::vector<std::uint64_t> packed(const LampField& field);

}  // namespace septet::render
