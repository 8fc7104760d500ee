#pragma once
/// What the shaders of one view know: light::ViewUniforms, and how it is filled.

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include "engine/instant/instant.hpp"
#include "engine/light/view_record.hpp"
#include "engine/render/passes/lamp_field.hpp"
#include "engine/render/passes/shadow_cascades.hpp"
#include "engine/render/words.hpp"

namespace septet::render {

using light::most_headlights, light::most_beacons, light::ViewUniforms;

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
