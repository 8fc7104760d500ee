#include "engine/render/passes/sky_pass.hpp"

#include <glm/gtc/packing.hpp>

#include "engine/render/passes/shaders.hpp"

namespace septet::render {
void destroy_sky_pass(SkyPass& pass, const vulkan::Device& device) {
  for (const VkPipeline pipeline : pass.pipelines)
    if (pipeline) vkDestroyPipeline(device.device, pipeline, nullptr);
  pass = {};
}

void draw_sky(SkyPass& pass, PassContext& context, bool clouded, bool starry) {
  VkPipeline& pipeline = pass.pipelines[std::size_t{clouded} + 2 * std::size_t{starry}];
  if (!pipeline) {
    vulkan::PipelineDescription description;
    description.vertex_code = shaders::sky_vert();
    description.fragment_code = shaders::sky_frag();
    description.vertex_input = vulkan::VertexInput::none;
    description.color_format = context.formats.radiance;
    description.marks = context.formats.marks;
    description.depth_format = context.formats.depth;
    description.samples = context.formats.samples;
    description.depth_write = false;  // At depth 0 it passes only where the depth is still cleared.
    description.constants = {clouded, starry};
    pipeline = create_pipeline(context.device, context.layout, description);
  }
  vkCmdSetCullMode(context.slot.commands, VK_CULL_MODE_NONE);
  vkCmdBindPipeline(context.slot.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
  vkCmdDraw(context.slot.commands, 3, 1, 0, 0);
  ++context.statistics.draws;
  ++context.statistics.triangles;
}

std::vector<std::uint64_t> packed(const SkyLight& light) {
  std::vector<std::uint64_t> texels;
  texels.reserve(std::size_t{sky_rows} * SkyTable::columns);
  const auto add = [&](const SkyTable& table) {
    for (const glm::vec3& radiance : table.radiance) texels.push_back(glm::packHalf4x16(glm::vec4(radiance, 1.0f)));
  };
  add(light.table);
  for (const SkyTable& mirrored : instant::sky_by_roughness(light)) add(mirrored);
  return texels;
}

}  // namespace septet::render
