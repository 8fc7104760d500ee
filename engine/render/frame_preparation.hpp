#pragma once
/// Content of a frame, decided on the CPU before anything is recorded: views, and the casters of shadows into them.

#include <array>
#include <optional>
#include <vector>

#include "engine/instant/instant.hpp"
#include "engine/render/passes/ice_pass.hpp"
#include "engine/render/passes/lamp_field.hpp"
#include "engine/render/passes/mirror_pass.hpp"
#include "engine/render/passes/road_mirror_pass.hpp"
#include "engine/render/passes/shadow_cascades.hpp"
#include "engine/render/passes/surface_draws.hpp"

namespace septet::render {

struct PreparedView {
  const FrameView* view = nullptr;
  SurfaceDraws draws;
  FrameData uniforms;
  FrameData light_clusters;  ///< Empty without clustered headlights, or without headlights.
  FrameData smoke_shade;     ///< That of the frame; empty without smoke in the light.
  FrameData glows;
  std::uint32_t glow_count = 0;
  FrameData contacts;
  std::uint32_t contact_count = 0;
  FrameData wet_lamps;
  std::uint32_t wet_lamp_count = 0;
  FrameData streaks;
  std::uint32_t streak_count = 0;
  FrameData smoke;
  std::uint32_t puff_count = 0;
  bool lit_by_headlights = false, lit_by_lamps = false;
  bool mirrored_by_road = false;  ///< True for the view that the road mirror holds.
  bool smoke_shaded() const { return smoke_shade.buffer != VK_NULL_HANDLE; }
};

struct PreparedFrame {
  std::vector<PreparedView> views;
  std::vector<PreparedView> mirror_views;  ///< Views in Instant::mirrors.
  PreparedGlass mirrors;                   ///< Glass of the mirrors in the first view.
  ShadowCascades shadows;
  std::optional<PreparedRoadMirror> road_mirror;  ///< Road mirror of the first view.
  std::array<SurfaceDraws, cascade_count> casters;
  IceTiles ice;
  IceUpload ice_upload;
  std::vector<FrameData> glass;   ///< Vertices of Instant::glass.
  std::vector<FrameView> around;  ///< Surroundings of the ice, six views each; empty when no view sees ice.
  std::vector<PreparedView> around_views;
  std::uint32_t surroundings() const { return static_cast<std::uint32_t>(around.size() / 6); }
};

/// Prepares a frame for a target of this size; `lamps`: those around the first view's eye; `offset_px`: see
/// view_uniforms.
PreparedFrame prepare_frame(PassContext& context, const DeviceScene& scene, const Instant& instant,
                            const LampField& lamps, std::uint32_t width, std::uint32_t height,
                            const glm::vec2& offset_px);

}  // namespace septet::render
