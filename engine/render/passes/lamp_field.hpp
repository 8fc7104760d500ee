#pragma once
/// What standing lamps (instant/standing_lamps.hpp) throw on the ground around the eye, as a picture from above: any number of them costs a pixel one sample.
///
/// A texel holds the sum of the light that arrives at the ground: as a vector toward where it comes from (its share on a surface is the
/// cosine with it), and in w its sum regardless of direction, negative where the lamps stand under a roof. Made anew only when the eye has gone on by 48 m, so
/// that it depends on where the eye is and not on where it was; 384 m wide.

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
  Vec2 corner_m{0.0};                 ///< World; of texel (0, 0).
  bool open = false, roofed = false;  ///< Are there lamps of that kind?
  glm::vec3 hue{1.0f};                ///< Their colour, of luminance 1.
  float roofed_height_m = 5.0f;       ///< Mean height of those under roofs.
  std::vector<glm::vec4> texels;      ///< Rows to the north; empty without lamps.

  /// Whether any of them lights something, where street lamps are lit as far (0 to 1).
  bool shine(float street_lamps) const { return roofed || (open && street_lamps > 0.0f); }
};

/// The corner of the field around an eye.
Vec2 lamp_field_corner(const Vec3& eye_m);
LampField lamp_field(std::span<const StandingLamp> lamps, const Vec2& corner_m);

/// As half floats for the device.
std::vector<std::uint64_t> packed(const LampField& field);

}  // namespace septet::render
