#include "engine/render/renderer_state.hpp"

#include <cstddef>
#include <utility>
#include <vector>

#include "engine/effects/ice/air_pattern.hpp"
#include "engine/instant/clouds.hpp"
#include "engine/render/mip_chain.hpp"
#include "engine/render/window.hpp"
#include "engine/render/window_surface.hpp"

namespace septet::render {

void create_state(RendererState& state, const RendererOptions& wanted) {
  state.options = wanted;
  state.memory.device = &state.device;
  vulkan::DeviceOptions device_options{wanted.device == DevicePreference::software, wanted.validation, {}, {}};
  if (wanted.window) add_window(device_options, *wanted.window);
  create_device(state.device, device_options);
  const VkSampleCountFlags samples = state.device.properties.limits.framebufferColorSampleCounts &
                                     state.device.properties.limits.framebufferDepthSampleCounts &
                                     state.device.properties.limits.sampledImageColorSampleCounts &
                                     state.device.properties.limits.sampledImageDepthSampleCounts;
  const bool software = state.device.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
  Antialiasing antialiasing = wanted.antialiasing;
  if (antialiasing == Antialiasing::automatic)
    antialiasing = software ? Antialiasing::smoothing : Antialiasing::multisampled;
  const bool multisampled = antialiasing == Antialiasing::multisampled && (samples & VK_SAMPLE_COUNT_4_BIT);
  state.formats.samples = multisampled ? VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_1_BIT;
  state.formats.marks = antialiasing == Antialiasing::temporal;
  state.smoothed = antialiasing == Antialiasing::smoothing || antialiasing == Antialiasing::temporal;
  state.refinements.soft_shadows =
      wanted.shadow_edges == ShadowEdges::soft || (wanted.shadow_edges == ShadowEdges::automatic && !software);
  state.refinements.clustered_headlights =
      wanted.headlights == Headlights::clustered || (wanted.headlights == Headlights::automatic && !software);
  create_frame_ring(state.ring, state.device, wanted.timed);
  create_pipeline_layout(state.layout, state.device);
  create_samplers(state.samplers, state.device);
  create_frame_targets(state.targets, state.memory, state.formats, wanted.width, wanted.height, state.smoothed);
  vulkan::ImageDescription table;
  table.width = SkyTable::columns;
  table.height = sky_rows;
  table.format = VK_FORMAT_R16G16B16A16_SFLOAT;
  table.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  state.sky_table = create_image(state.memory, table);
  table.width = table.height = LampField::side;
  state.lamp_image = create_image(state.memory, table);
  vulkan::Upload upload(state.device, state.memory);
  constexpr std::uint32_t side = instant::cloud_noise_side;
  const std::vector<std::uint8_t> ranks = instant::cloud_noise(), air = ice::air_pattern(ranks, side);
  std::vector<std::uint8_t> texels;
  for (std::size_t i = 0; i < ranks.size(); ++i) texels.insert(texels.end(), {ranks[i], air[i], ranks[i], ranks[i]});
  state.noise = create_texture(upload, texture_levels(side, side, texels, false));
  upload.finish();
  create_shadow_pass(state.shadow_pass, state.device, state.layout, state.formats.depth);
  create_contact_pass(state.contact_pass, state.device, state.layout, state.formats, state.refinements);
  create_glow_pass(state.glow_pass, state.device, state.layout, state.formats);
  create_mirror_pass(state.mirror_pass, state.device, state.layout, state.formats);
  create_precipitation_pass(state.precipitation_pass, state.device, state.layout, state.formats);
  create_smoke_pass(state.smoke_pass, state.device, state.layout, state.formats);
  if (state.formats.marks) {
    create_temporal_pass(state.temporal_pass, state.device, state.layout, state.formats);
    create_temporal_targets(state.temporal_pass, state.memory, state.formats, wanted.width, wanted.height);
  }
  if (wanted.bloom == Bloom::present || (wanted.bloom == Bloom::automatic && !software)) {
    create_bloom_pass(state.bloom_pass, state.device, state.layout, state.formats);
    create_bloom_targets(state.bloom_pass, state.memory, state.formats, wanted.width, wanted.height);
  }
  create_tone_mapping_pass(state.tone_mapping_pass, state.device, state.layout, state.formats);
  create_smoothing_pass(state.smoothing_pass, state.device, state.layout, state.formats.picture);
  Expected<image::Font> font = image::Font::find(image::FontStyle::bold);
  if (!font) throw vulkan::Failure{font.error()};
  state.overlay_pass.emplace(OverlayPass{VK_NULL_HANDLE, std::move(*font), {}, {}, {}});
  create_overlay_pass(*state.overlay_pass, state.device, state.memory, state.layout, state.formats);
}

RendererState::~RendererState() {
  if (!device.device) {
    destroy_device(device);
    return;
  }
  vkDeviceWaitIdle(device.device);
  if (overlay_pass) destroy_overlay_pass(*overlay_pass, device, memory);
  destroy_smoothing_pass(smoothing_pass, device);
  destroy_tone_mapping_pass(tone_mapping_pass, device);
  destroy_bloom_pass(bloom_pass, device, memory);
  destroy_temporal_pass(temporal_pass, device, memory);
  destroy_ice_pass(ice_pass, device, memory);
  destroy_road_mirror(road_mirror_pass, device, memory);
  destroy_mirror_pass(mirror_pass, device, memory);
  destroy_smoke_pass(smoke_pass, device);
  destroy_precipitation_pass(precipitation_pass, device);
  destroy_contact_pass(contact_pass, device);
  destroy_glow_pass(glow_pass, device);
  destroy_sky_pass(sky_pass, device);
  destroy_shadow_pass(shadow_pass, device);
  destroy_surface_pass(surface_pass, device);
  destroy_scene(scene, memory);
  destroy_image(memory, noise);
  destroy_image(memory, lamp_image);
  destroy_image(memory, sky_table);
  destroy_frame_targets(targets, memory);
  destroy_swapchain(swapchain, device);
  destroy_samplers(samplers, device);
  destroy_pipeline_layout(layout, device);
  destroy_frame_ring(ring, device, memory);
  destroy_memory(memory);
  destroy_device(device);
}

void resize_targets(RendererState& state, std::uint32_t width, std::uint32_t height) {
  wait_for_frames(state.ring, state.device);
  destroy_frame_targets(state.targets, state.memory);
  create_frame_targets(state.targets, state.memory, state.formats, width, height, state.smoothed);
  if (state.temporal_pass.present()) {
    destroy_temporal_targets(state.temporal_pass, state.memory);
    create_temporal_targets(state.temporal_pass, state.memory, state.formats, width, height);
  }
  if (state.bloom_pass.present()) {
    destroy_bloom_targets(state.bloom_pass, state.memory);
    create_bloom_targets(state.bloom_pass, state.memory, state.formats, width, height);
  }
  state.drawn = false;
  state.swapchain.stale = true;
}

}  // namespace septet::render
