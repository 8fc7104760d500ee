#include "engine/render/passes/smoothing_pass.hpp"

#include "engine/render/passes/shaders.hpp"
#include "engine/render/passes/whole_target.hpp"

namespace septet::render {

void create_smoothing_pass(SmoothingPass& pass, const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                           VkFormat format) {
  pass.pipeline = create_whole_target_pipeline(device, layout, format, shaders::smoothing_frag());
}

void destroy_smoothing_pass(SmoothingPass& pass, const vulkan::Device& device) {
  if (pass.pipeline) vkDestroyPipeline(device.device, pass.pipeline, nullptr);
  pass = {};
}

void draw_smoothed(const SmoothingPass& pass, PassContext& context, VkImageView source, VkImageView target,
                   std::uint32_t width, std::uint32_t height) {
  const glm::vec4 pixel(1.0f / static_cast<float>(width), 1.0f / static_cast<float>(height), 0.0f, 0.0f);
  draw_whole_target(pass.pipeline, context, source, target, width, height, pixel);
}

}  // namespace septet::render
