#include "engine/render/passes/whole_target.hpp"

#include "engine/render/passes/shaders.hpp"

namespace septet::render {

VkPipeline create_whole_target_pipeline(const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                                        VkFormat format, std::span<const std::uint32_t> fragment_code,
                                        vulkan::Blend blend, VkSampleCountFlagBits samples) {
  vulkan::PipelineDescription description;
  description.vertex_code = shaders::whole_target_vert();
  description.fragment_code = fragment_code;
  description.vertex_input = vulkan::VertexInput::none;
  description.color_format = format;
  description.depth_write = false;
  description.blend = blend;
  description.samples = samples;
  return create_pipeline(device, layout, description);
}

namespace {

void draw(VkAttachmentLoadOp load, VkPipeline pipeline, PassContext& context, VkImageView source, VkImageView target,
          std::uint32_t width, std::uint32_t height, const glm::vec4& constants) {
  const VkCommandBuffer commands = context.slot.commands;
  VkRenderingAttachmentInfo color{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  color.imageView = target;
  color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  color.loadOp = load;
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  color.clearValue.color = {{0.0f, 0.0f, 0.0f, 1.0f}};
  VkRenderingInfo rendering{VK_STRUCTURE_TYPE_RENDERING_INFO};
  rendering.renderArea = {{0, 0}, {width, height}};
  rendering.layerCount = 1;
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachments = &color;
  vkCmdBeginRendering(commands, &rendering);
  set_viewport(context, {0, 0, width, height});
  vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
  vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
  push_image(context, source, context.samplers.table);
  push_constants(context, std::as_bytes(std::span(&constants, 1)));
  vkCmdDraw(commands, 3, 1, 0, 0);
  ++context.statistics.draws;
  ++context.statistics.triangles;
  vkCmdEndRendering(commands);
}

}  // namespace

void draw_whole_target(VkPipeline pipeline, PassContext& context, VkImageView source, VkImageView target,
                       std::uint32_t width, std::uint32_t height, const glm::vec4& constants) {
  // Clears for the alpha, which drawing leaves unchanged.
  draw(VK_ATTACHMENT_LOAD_OP_CLEAR, pipeline, context, source, target, width, height, constants);
}

void draw_over_whole_target(VkPipeline pipeline, PassContext& context, VkImageView source, VkImageView target,
                            std::uint32_t width, std::uint32_t height, const glm::vec4& constants) {
  draw(VK_ATTACHMENT_LOAD_OP_LOAD, pipeline, context, source, target, width, height, constants);
}

}  // namespace septet::render
