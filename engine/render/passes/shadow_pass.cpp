#include "engine/render/passes/shadow_pass.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

#include <glm/vec4.hpp>

#include "engine/light/records.hpp"
#include "engine/render/passes/shaders.hpp"

namespace septet::render {
namespace {

constexpr std::uint32_t cut_bit = 1, fading_bit = 2;

using light::CascadeConstants;

}  // namespace

void create_shadow_pass(ShadowPass& pass, const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                        VkFormat format) {
  vulkan::PipelineDescription description;
  description.vertex_code = shaders::shadow_vert();
  description.vertex_input = vulkan::VertexInput::shadow;
  description.depth_format = format;
  description.clamp_depth = true;
  // Bias away from the light, towards lesser depth.
  description.depth_bias = -2.0f;
  description.depth_bias_slope = -1.6f;
  for (std::uint32_t bits = 0; bits < pass.pipelines.size(); ++bits) {
    if (bits & cut_bit)
      description.fragment_code = shaders::shadow_cut_frag();
    else if (bits & fading_bit)
      description.fragment_code = shaders::shadow_fade_frag();
    else
      description.fragment_code = {};
    description.constants[10] = bits & fading_bit;
    pass.pipelines[bits] = create_pipeline(device, layout, description);
  }
}

void destroy_shadow_pass(ShadowPass& pass, const vulkan::Device& device) {
  for (const VkPipeline pipeline : pass.pipelines)
    if (pipeline) vkDestroyPipeline(device.device, pipeline, nullptr);
  pass = {};
}

void draw_shadows(const ShadowPass& pass, PassContext& context, const DeviceScene& scene, const SurfaceDraws& draws,
                  const Cascade& cascade, VkImageView target) {
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
  if (!draws.list.empty()) bind_instances(context, draws.records);
  const CascadeConstants constants{clip_from_relative(cascade), glm::vec4(cascade.first_texel, 0.0f, 0.0f)};
  push_constants(context, std::as_bytes(std::span(&constants, 1)));
  VkPipeline bound_pipeline = VK_NULL_HANDLE;
  SurfaceDraw bound;
  const std::uint32_t triangles_before = context.statistics.triangles;
  for (const SurfaceDraw& draw : draws.list) {
    const DeviceMaterial& material = scene.materials[draw.material];
    const VkPipeline pipeline = pass.pipelines[(material.cut ? cut_bit : 0u) | (draw.fading ? fading_bit : 0u)];
    if (pipeline != bound_pipeline) vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    bound_pipeline = pipeline;
    if (material.cut) {
      const DeviceTexture& texture = scene.textures[static_cast<std::size_t>(material.image)];
      push_image(context, texture.image.view, context.samplers.of(texture.sampling));
    }
    record_draw(context, draw, bound);
  }
  context.statistics.shadow_triangles += context.statistics.triangles - triangles_before;
  vkCmdEndRendering(commands);
}

}  // namespace septet::render
