#pragma once
/// Smooths the stairs of edges in a picture of one sample a pixel, for devices on which multisampling costs too much.
/// Edges are found as the eye sees them, so it works on the display's codes, after tone mapping.

#include "engine/render/passes/pass_context.hpp"

namespace septet::render {

struct SmoothingPass {
  VkPipeline pipeline = VK_NULL_HANDLE;
};

void create_smoothing_pass(SmoothingPass& pass, const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                           VkFormat format);
void destroy_smoothing_pass(SmoothingPass& pass, const vulkan::Device& device);

/// Draws from `source`, which is sampled, into all of `target`; both have this size.
void draw_smoothed(const SmoothingPass& pass, PassContext& context, VkImageView source, VkImageView target,
                   std::uint32_t width, std::uint32_t height);

}  // namespace septet::render
