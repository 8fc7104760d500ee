#pragma once
/// Exposure and tone mapping: from the frame's linear radiance to the display's codes, once a pixel, after all sources
/// and absorbers of light have been drawn.

#include "engine/render/passes/pass_context.hpp"

namespace septet::render {

struct ToneMappingPass {
  VkPipeline pipeline = VK_NULL_HANDLE;
};

void create_tone_mapping_pass(ToneMappingPass& pass, const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                              const TargetFormats& formats);
void destroy_tone_mapping_pass(ToneMappingPass& pass, const vulkan::Device& device);

/// Draws from `radiance`, with the samples of the formats, into all of `target`; both have this size. `exposure`: from
/// radiance to the tone curve (engine/light/tone_curve.hpp).
void draw_tone_mapped(const ToneMappingPass& pass, PassContext& context, VkImageView radiance, VkImageView target,
                      std::uint32_t width, std::uint32_t height, float exposure);

}  // namespace septet::render
