#include "engine/render/passes/smoothing_pass.hpp"

#include "engine/render/passes/shaders.hpp"

namespace septet::render {

void create_smoothing_pass(SmoothingPass& pass, const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                           VkFormat format) {
  vulkan::PipelineDescription description;
  description.vertex_code = shaders::smoothing_vert();
  description.fragment_code = shaders::smoothing_frag();
  description.vertex_input = vulkan::VertexInput::none;
  description.color_format = format;
  description.depth_write = false;
  pass.pipeline = create_pipeline(device, layout, description);
}

void destroy_smoothing_pass(SmoothingPass& pass, const vulkan::Device& device) {
  if (pass.pipeline) vkDestroyPipeline(device.device, pass.pipeline, nullptr);
  pass = {};
}

void draw_smoothed(const SmoothingPass& pass, PassContext& context, VkImageView source, VkImageView target,
                   std::uint32_t width, std::uint32_t height) {
  const VkCommandBuffer commands = context.slot.commands;
  VkRenderingAttachmentInfo color{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  color.imageView = target;
  color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;  // For the alpha, which drawing leaves alone.
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
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pass.pipeline);
  push_image(context, source, context.samplers.table);
  const glm::vec4 pixel(1.0f / static_cast<float>(width), 1.0f / static_cast<float>(height), 0.0f, 0.0f);
  push_constants(context, std::as_bytes(std::span(&pixel, 1)));
  vkCmdDraw(commands, 3, 1, 0, 0);
  ++context.statistics.draws;
  ++context.statistics.triangles;
  vkCmdEndRendering(commands);
}

}  // namespace septet::render
