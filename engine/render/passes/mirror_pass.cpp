#include "engine/render/passes/mirror_pass.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/light/records.hpp"
#include "engine/render/passes/shaders.hpp"

namespace septet::render {
namespace {

using light::GlassRecord;

VkExtent2D extent_of(std::span<const MirrorGlass> mirrors) {
  VkExtent2D extent{1, 1};
  for (const MirrorGlass& mirror : mirrors) {
    const PixelRectangle& part = mirror.picture.viewport;
    extent.width = std::max(extent.width, static_cast<std::uint32_t>(part.x) + part.width);
    extent.height = std::max(extent.height, static_cast<std::uint32_t>(part.y) + part.height);
  }
  return extent;
}

}  // namespace

void create_mirror_pass(MirrorPass& pass, const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                        const TargetFormats& formats) {
  vulkan::PipelineDescription description;
  description.vertex_code = shaders::mirror_glass_vert();
  description.fragment_code = shaders::mirror_glass_frag();
  description.vertex_input = vulkan::VertexInput::none;
  description.color_format = formats.radiance;
  description.marks = formats.marks;
  description.depth_format = formats.depth;
  description.samples = formats.samples;
  pass.pipeline = create_pipeline(device, layout, description);
}

void destroy_mirror_pass(MirrorPass& pass, const vulkan::Device& device, vulkan::MemoryPool& memory) {
  if (pass.pipeline) vkDestroyPipeline(device.device, pass.pipeline, nullptr);
  for (vulkan::DeviceImage* image : {&pass.picture, &pass.samples, &pass.depth}) destroy_image(memory, *image);
  pass = {};
}

bool mirrors_fit(const MirrorPass& pass, std::span<const MirrorGlass> mirrors) {
  const VkExtent2D needed = extent_of(mirrors);
  return pass.picture.image != VK_NULL_HANDLE && pass.picture.description.width >= needed.width &&
         pass.picture.description.height >= needed.height;
}

void prepare_mirror_targets(MirrorPass& pass, vulkan::MemoryPool& memory, const TargetFormats& formats,
                            std::span<const MirrorGlass> mirrors) {
  // Room to spare: the pictures change a little in size with every movement of the head.
  const VkExtent2D needed = extent_of(mirrors);
  const auto with_room = [](std::uint32_t px, std::uint32_t held_px) {
    return std::max(held_px, (px + px / 8 + 63) / 64 * 64);
  };
  vulkan::ImageDescription description;
  description.width = with_room(needed.width, pass.picture.description.width);
  description.height = with_room(needed.height, pass.picture.description.height);
  for (vulkan::DeviceImage* image : {&pass.picture, &pass.samples, &pass.depth}) destroy_image(memory, *image);
  pass.picture_access = pass.samples_access = pass.depth_access = Access::none;
  description.format = formats.radiance;
  description.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  pass.picture = create_image(memory, description);
  const bool multisampled = formats.samples != VK_SAMPLE_COUNT_1_BIT;
  vulkan::ImageDescription samples = description;
  samples.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  samples.samples = formats.samples;
  if (!multisampled) samples.width = samples.height = 1;
  pass.samples = create_image(memory, samples);
  description.format = formats.depth;
  description.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
  description.aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
  description.samples = formats.samples;
  pass.depth = create_image(memory, description);
}

void begin_mirror_rendering(const MirrorPass& pass, PassContext& context, std::span<const MirrorGlass> mirrors) {
  VkRenderingAttachmentInfo color{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  color.imageView = pass.picture.view;
  color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  color.clearValue.color = {{0.0f, 0.0f, 0.0f, 1.0f}};
  if (pass.multisampled()) {
    color.imageView = pass.samples.view;
    color.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    color.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    color.resolveImageView = pass.picture.view;
    color.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  }
  VkRenderingAttachmentInfo depth{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  depth.imageView = pass.depth.view;
  depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
  depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  depth.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  depth.clearValue.depthStencil = {0.0f, 0};
  VkRenderingInfo rendering{VK_STRUCTURE_TYPE_RENDERING_INFO};
  rendering.renderArea = {{0, 0}, extent_of(mirrors)};
  rendering.layerCount = 1;
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachments = &color;
  rendering.pDepthAttachment = &depth;
  vkCmdBeginRendering(context.slot.commands, &rendering);
}

PreparedGlass prepare_mirror_glass(PassContext& context, std::span<const MirrorGlass> mirrors, const Vec3& eye_m) {
  std::vector<GlassRecord> records;
  for (const MirrorGlass& mirror : mirrors) {
    const PixelRectangle& part = mirror.picture.viewport;
    const glm::vec2 origin(part.x, part.y), size(part.width, part.height);
    for (const MirrorGlass::Corner& corner : mirror.corners) {
      const Vec3 place = mirror.picture.world_from_car * corner.position_m - eye_m;
      records.push_back(
          {glm::vec4(glm::vec3(place), mirror.reflectance), glm::vec4(origin + corner.at * size, 0.0f, 0.0f)});
    }
  }
  PreparedGlass prepared;
  prepared.count = static_cast<std::uint32_t>(records.size());
  if (prepared.count > 0) prepared.corners = store(context, std::span<const GlassRecord>(records));
  return prepared;
}

void draw_mirror_glass(const MirrorPass& pass, PassContext& context, const PreparedGlass& glass) {
  vkCmdSetCullMode(context.slot.commands, VK_CULL_MODE_BACK_BIT);
  vkCmdBindPipeline(context.slot.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pass.pipeline);
  push_image(context, pass.picture.view, context.samplers.table);
  push_records(context, glass.corners);
  vkCmdDraw(context.slot.commands, glass.count, 1, 0, 0);
  ++context.statistics.draws;
  context.statistics.triangles += glass.count / 3;
}

}  // namespace septet::render
