#pragma once
/// What a frame draws, decided on the CPU before anything is recorded: views, and what throws shadows into them.

#include <array>
#include <vector>

#include "engine/render/atmosphere.hpp"
#include "engine/render/frame_input.hpp"
#include "engine/render/passes/participants.hpp"
#include "engine/render/passes/shadow_cascades.hpp"
#include "engine/render/passes/surface_draws.hpp"

namespace septet::render {

struct PreparedView {
  const FrameView* view = nullptr;
  SurfaceDraws draws;
  FrameData uniforms;
  FrameData glows;
  std::uint32_t glow_count = 0;
  FrameData smoke;
  std::uint32_t puff_count = 0;
  bool lit_by_headlights = false;
};

struct PreparedFrame {
  float exposure = 1.0f;  ///< From radiance to the tone curve (tone_curve.hpp): one for all views, and for all screens of a rig.
  std::vector<PreparedView> views;
  ShadowCascades shadows;
  std::array<SurfaceDraws, cascade_count> casters;
};

PreparedFrame prepare_frame(PassContext& context, const DeviceScene& scene, const SkyLight& light, const FrameInput& input);

}  // namespace septet::render
