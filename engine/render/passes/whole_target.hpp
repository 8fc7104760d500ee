#pragma once
/// Passes that draw one triangle over a whole target, from an image that is sampled: tone mapping, smoothing, bloom.

#include <glm/vec4.hpp>

#include "engine/render/passes/pass_context.hpp"

namespace septet::render {

VkPipeline create_whole_target_pipeline(const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                                        VkFormat format, std::span<const std::uint32_t> fragment_code,
                                        vulkan::Blend blend = vulkan::Blend::none,
                                        VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT);

/// Draws over a target of this size; `constants`: those of the fragment shader. The target's old contents are lost.
void draw_whole_target(VkPipeline pipeline, PassContext& context, VkImageView source, VkImageView target,
                       std::uint32_t width, std::uint32_t height, const glm::vec4& constants);
/// Draws likewise, blended with the target's contents.
void draw_over_whole_target(VkPipeline pipeline, PassContext& context, VkImageView source, VkImageView target,
                            std::uint32_t width, std::uint32_t height, const glm::vec4& constants);

}  // namespace septet::render
