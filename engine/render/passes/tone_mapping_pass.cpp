#include "engine/render/passes/tone_mapping_pass.hpp"

#include "engine/render/passes/shaders.hpp"
#include "engine/render/passes/whole_target.hpp"

namespace septet::render {

void create_tone_mapping_pass(ToneMappingPass& pass, const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                              const TargetFormats& formats) {
  const bool multisampled = formats.samples != VK_SAMPLE_COUNT_1_BIT;
  pass.pipeline =
      create_whole_target_pipeline(device, layout, formats.picture,
                                   multisampled ? shaders::tone_mapping_samples_frag() : shaders::tone_mapping_frag());
}

void destroy_tone_mapping_pass(ToneMappingPass& pass, const vulkan::Device& device) {
  if (pass.pipeline) vkDestroyPipeline(device.device, pass.pipeline, nullptr);
  pass = {};
}

void draw_tone_mapped(const ToneMappingPass& pass, PassContext& context, VkImageView radiance, VkImageView target,
                      std::uint32_t width, std::uint32_t height, float exposure) {
  draw_whole_target(pass.pipeline, context, radiance, target, width, height, glm::vec4(exposure, 0.0f, 0.0f, 0.0f));
}

}  // namespace septet::render
