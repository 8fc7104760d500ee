#include "engine/render/passes/shadow_pass.hpp"

#include "engine/render/passes/shaders.hpp"

namespace septet::render {

void create_shadow_pass(ShadowPass& pass, const vulkan::Device& device, const vulkan::PipelineLayout& layout, VkFormat format) {
  vulkan::PipelineDescription description;
  description.vertex_code = shaders::shadow_vert();
  description.vertex_input = vulkan::VertexInput::position_uv;
  description.depth_format = format;
  description.clamp_depth = true;
  // Away from the light, which is where depth is less.
  description.depth_bias = -2.0f;
  description.depth_bias_slope = -1.6f;
  pass.solid = create_pipeline(device, layout, description);
  description.fragment_code = shaders::shadow_cut_frag();
  pass.cut = create_pipeline(device, layout, description);
}

void destroy_shadow_pass(ShadowPass& pass, const vulkan::Device& device) {
  if (pass.solid) vkDestroyPipeline(device.device, pass.solid, nullptr);
  if (pass.cut) vkDestroyPipeline(device.device, pass.cut, nullptr);
  pass = {};
}

void draw_shadows(const ShadowPass& pass, PassContext& context, const DeviceScene& scene, const DrawList& list,
                  const FrameData& records, const Cascade& cascade, VkImageView target) {
  const VkCommandBuffer commands = context.slot.commands;
  VkRenderingAttachmentInfo depth{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  depth.imageView = target;
  depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
  depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  depth.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  VkRenderingInfo rendering{VK_STRUCTURE_TYPE_RENDERING_INFO};
  rendering.renderArea = {{0, 0}, {cascade_texels, cascade_texels}};
  rendering.layerCount = 1;
  rendering.pDepthAttachment = &depth;
  vkCmdBeginRendering(commands, &rendering);
  set_viewport(context, {0, 0, cascade_texels, cascade_texels});
  vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
  vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
  push_records(context, records);
  const glm::mat4 clip = clip_from_relative(cascade);
  push_constants(context, std::as_bytes(std::span(&clip, 1)));
  VkPipeline bound = VK_NULL_HANDLE;
  for (const Batch& batch : list.batches) {
    const DeviceMesh& mesh = scene.meshes[batch.mesh];
    bool bound_mesh = false;
    for (const scene::MeshPart& part : mesh.parts) {
      if (part.material >= scene.materials.size()) continue;
      const DeviceMaterial& material = scene.materials[part.material];
      if (material.blended) continue;
      const VkPipeline pipeline = material.cut ? pass.cut : pass.solid;
      if (pipeline != bound) vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
      bound = pipeline;
      if (material.cut)
        push_image(context, scene.textures[static_cast<std::size_t>(material.image)].image.view, context.samplers.surface);
      if (!bound_mesh) {
        const VkDeviceSize at = 0;
        vkCmdBindVertexBuffers(commands, 0, 1, &mesh.buffer.buffer, &at);
        vkCmdBindIndexBuffer(commands, mesh.buffer.buffer, mesh.indices_at, VK_INDEX_TYPE_UINT32);
        bound_mesh = true;
      }
      vkCmdDrawIndexed(commands, part.index_count, batch.count, part.first_index, 0, batch.first);
      context.statistics.triangles += part.index_count / 3 * batch.count;
      context.statistics.shadow_triangles += part.index_count / 3 * batch.count;
      ++context.statistics.draws;
    }
  }
  vkCmdEndRendering(commands);
}

}  // namespace septet::render
