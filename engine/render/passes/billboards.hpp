#pragma once
/// Squares that face the viewer, blended over the picture: glows of lamps, puffs of smoke. They have no vertices of
/// their own and write no depth; they differ in their shaders, their blending, and the records that the vertex shader
/// reads.

#include "engine/render/passes/pass_context.hpp"

namespace septet::render {

VkPipeline create_billboard_pipeline(const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                                     const TargetFormats& formats, std::span<const std::uint32_t> vertex_code,
                                     std::span<const std::uint32_t> fragment_code, vulkan::Blend blend,
                                     const Refinements& refinements = {});

/// Draws `count` of them, in the order of their records.
void draw_billboards(VkPipeline pipeline, PassContext& context, const FrameData& records, std::uint32_t count);

}  // namespace septet::render
