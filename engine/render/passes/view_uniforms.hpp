#pragma once
/// What the shaders of one view know: the twin of shaders/view.glsl, and how it is filled.

#include <array>
#include <span>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "engine/instant/instant.hpp"
#include "engine/render/passes/lamp_field.hpp"
#include "engine/render/passes/shadow_cascades.hpp"
#include "engine/render/words.hpp"

namespace septet::render {

inline constexpr std::size_t most_headlights = 10, most_beacons = 4;

struct ViewUniforms {
  glm::mat4 clip_from_relative;
  glm::mat4 shadow_from_relative;
  glm::vec4 far_from_near;
  glm::vec4 light_direction, light_irradiance, sky_irradiance, ground_irradiance, sun_direction, sun_level;
  std::array<glm::vec4, 7> irradiance;
  glm::vec4 ray_middle, ray_right, ray_down;
  glm::vec4 billboard_right, billboard_up;
  glm::vec4 weather, wind;
  std::array<glm::vec4, most_headlights> headlight_position, headlight_direction;
  glm::vec4 soot_x, soot_y, soot_z, soot_size;
  glm::vec4 lamp_field, lamp_hue;
  glm::vec4 road, water, target;
  glm::vec4 offset;
  std::array<glm::vec4, most_beacons> beacon_position, beacon_intensity;
};
static_assert(sizeof(ViewUniforms) == (4 * 2 + 21 + 2 * most_headlights + 6 + 4 + 2 * most_beacons) * 16);

/// Where the wet road's mirror image of a view lies in a picture.
struct RoadMirror {
  bool present = false;
  std::uint32_t width = 1, height = 1;  ///< Of the picture, pixels.
};

/// From what is relative to the eye, along the world's axes.
glm::dmat4 clip_from_relative(const FrameView& view);
/// What stands still has this much of its (reversed) depth where its samples are shifted: half a pixel aside, a face that is seen at up to 76° would
/// else come before what lies on it and is not shifted.
double kept_depth(const FrameView& view);

/// Of the headlights the nearest count. `offset_px`: of the samples of what stands still, from the middles of their pixels.
ViewUniforms view_uniforms(const FrameView& view, const Instant& instant, const ShadowCascades& shadows,
                           const LampField& lamps, const RoadMirror& mirror = {},
                           const glm::vec2& offset_px = glm::vec2(0.0f));

}  // namespace septet::render
