#pragma once
/// Uniforms of one view's shaders: light::ViewUniforms, and how it is filled.

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include "engine/instant/instant.hpp"
#include "engine/light/view_record.hpp"
#include "engine/render/passes/lamp_field.hpp"
#include "engine/render/passes/shadow_cascades.hpp"
#include "engine/render/words.hpp"

namespace septet::render {

using light::most_headlights, light::most_beacons, light::ViewUniforms;

/// Place of the wet road's mirror image of a view.
struct RoadMirror {
  bool present = false;
  std::uint32_t width = 1, height = 1;  ///< Size of the picture, pixels.
};

/// Matrix to clip space from points relative to the eye, along the world's axes.
glm::dmat4 clip_from_relative(const FrameView& view);
/// Factor on the (reversed) depth of static surfaces whose samples are shifted: at half a pixel's shift, a face seen at
/// up to 76° would otherwise come before unshifted surfaces that lie on it.
double kept_depth(const FrameView& view);

/// Fills the uniforms; only the nearest headlights and beacons are included. `offset_px`: samples of static surfaces
/// relative to the pixels' centres.
ViewUniforms view_uniforms(const FrameView& view, const Instant& instant, const ShadowCascades& shadows,
                           const LampField& lamps, const RoadMirror& mirror = {},
                           const glm::vec2& offset_px = glm::vec2(0.0f));

}  // namespace septet::render
