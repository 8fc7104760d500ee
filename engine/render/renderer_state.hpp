#pragma once
/// State that a Renderer keeps from frame to frame: the device, its images and pipelines, and their accesses in the
/// last frame.

#include <cstdint>
#include <memory>
#include <optional>

#include "engine/instant/instant.hpp"
#include "engine/render/passes/bloom_pass.hpp"
#include "engine/render/passes/contact_pass.hpp"
#include "engine/render/passes/device_scene.hpp"
#include "engine/render/passes/frame_targets.hpp"
#include "engine/render/passes/glow_pass.hpp"
#include "engine/render/passes/ice_pass.hpp"
#include "engine/render/passes/lamp_field.hpp"
#include "engine/render/passes/mirror_pass.hpp"
#include "engine/render/passes/overlay_pass.hpp"
#include "engine/render/passes/precipitation_pass.hpp"
#include "engine/render/passes/road_mirror_pass.hpp"
#include "engine/render/passes/shadow_pass.hpp"
#include "engine/render/passes/sky_pass.hpp"
#include "engine/render/passes/smoke_pass.hpp"
#include "engine/render/passes/smoothing_pass.hpp"
#include "engine/render/passes/surface_pass.hpp"
#include "engine/render/passes/temporal_pass.hpp"
#include "engine/render/passes/tone_mapping_pass.hpp"
#include "engine/render/renderer.hpp"
#include "engine/render/vulkan/swapchain.hpp"

namespace septet::render {

struct RendererState {
  RendererOptions options;
  vulkan::Device device;
  vulkan::MemoryPool memory;
  vulkan::FrameRing ring;
  vulkan::PipelineLayout layout;
  Samplers samplers;
  TargetFormats formats;
  Refinements refinements;
  FrameTargets targets;
  vulkan::Swapchain swapchain;  ///< Only with a window.
  vulkan::DeviceImage sky_table, noise, lamp_image;
  LampField lamps;                              ///< Content of the image; its texels only until uploaded.
  std::optional<std::uint64_t> lamps_revision;  ///< Revision of the scene of these lamps.
  DeviceScene scene;
  SurfacePass surface_pass;
  ShadowPass shadow_pass;
  SkyPass sky_pass;
  ContactPass contact_pass;
  GlowPass glow_pass;
  PrecipitationPass precipitation_pass;
  SmokePass smoke_pass;
  RoadMirrorPass road_mirror_pass;
  MirrorPass mirror_pass;
  IcePass ice_pass;
  TemporalPass temporal_pass;
  BloomPass bloom_pass;
  ToneMappingPass tone_mapping_pass;
  SmoothingPass smoothing_pass;
  std::optional<OverlayPass> overlay_pass;
  std::optional<Environment> lit_environment;
  std::shared_ptr<const SkyLight> light;  ///< Light of that environment, for frames that bring none.
  Access sky_table_access = Access::none, lamps_access = Access::none, atlas_access = Access::none;
  bool smoothed = false;
  bool drawn = false;
  Exposure exposure;                            ///< Exposure of the last frame.
  std::shared_ptr<const SkyLight> table_light;  ///< Light whose sky the table holds.
  RenderStatistics statistics;

  RendererState() = default;
  RendererState(const RendererState&) = delete;
  RendererState& operator=(const RendererState&) = delete;
  ~RendererState();
};

/// Creates the whole state. Throws vulkan::Failure; parts created until then are destroyed with the state.
void create_state(RendererState& state, const RendererOptions& wanted);
/// Resizes everything that depends on the picture's size. Throws vulkan::Failure.
void resize_targets(RendererState& state, std::uint32_t width, std::uint32_t height);

}  // namespace septet::render
