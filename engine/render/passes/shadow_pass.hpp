#pragma once
/// Draws the casters between the light and the ground into one cascade of the shadow map.

#include <array>

#include "engine/render/passes/shadow_cascades.hpp"
#include "engine/render/passes/surface_draws.hpp"

namespace septet::render {

struct ShadowPass {
  std::array<VkPipeline, 4> pipelines{};  ///< Index bits: with holes, fading.
};

void create_shadow_pass(ShadowPass& pass, const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                        VkFormat format);
void destroy_shadow_pass(ShadowPass& pass, const vulkan::Device& device);

void draw_shadows(const ShadowPass& pass, PassContext& context, const DeviceScene& scene, const SurfaceDraws& draws,
                  const Cascade& cascade, VkImageView target);

}  // namespace septet::render
