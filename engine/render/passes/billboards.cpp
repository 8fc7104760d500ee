#include "engine/render/passes/billboards.hpp"

#include "engine/render/passes/shaders.hpp"

namespace septet::render {

VkPipeline create_billboard_pipeline(const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                                     const TargetFormats& formats, std::span<const std::uint32_t> vertex_code,
                                     std::span<const std::uint32_t> fragment_code, vulkan::Blend blend,
                                     const Refinements& refinements) {
  vulkan::PipelineDescription description;
  description.vertex_code = vertex_code;
  description.fragment_code = fragment_code;
  description.vertex_input = vulkan::VertexInput::none;
  description.color_format = formats.radiance;
  description.marks = formats.marks;
  description.depth_format = formats.depth;
  description.samples = formats.samples;
  description.blend = blend;
  description.depth_write = false;
  description.constants[shaders::soft_shadows_constant] = refinements.soft_shadows;
  return create_pipeline(device, layout, description);
}

void draw_billboards(VkPipeline pipeline, PassContext& context, const FrameData& records, std::uint32_t count) {
  if (count == 0) return;
  vkCmdSetCullMode(context.slot.commands, VK_CULL_MODE_NONE);
  vkCmdBindPipeline(context.slot.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
  push_records(context, records);
  vkCmdDraw(context.slot.commands, 6, count, 0, 0);
  ++context.statistics.draws;
  context.statistics.triangles += 2 * count;
}

}  // namespace septet::render
