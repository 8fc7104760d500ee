#include "engine/render/frame_targets.hpp"

#include <cstring>

#include "engine/core/check.hpp"
#include "engine/render/passes/shadow_cascades.hpp"

namespace septet::render {

void create_frame_targets(FrameTargets& targets, vulkan::MemoryPool& memory, const TargetFormats& formats,
                          std::uint32_t width, std::uint32_t height, bool smoothed) {
  targets.width = width;
  targets.height = height;
  vulkan::ImageDescription description;
  description.width = width;
  description.height = height;
  description.format = formats.color;
  description.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  targets.picture = create_image(memory, description);
  if (smoothed) {
    description.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    targets.drawn = create_image(memory, description);
  }
  description.samples = formats.samples;
  if (formats.samples != VK_SAMPLE_COUNT_1_BIT) {
    description.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    targets.samples = create_image(memory, description);
  }
  description.format = formats.depth;
  description.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
  description.aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
  targets.depth = create_image(memory, description);
  description.width = description.height = cascade_texels;
  description.samples = VK_SAMPLE_COUNT_1_BIT;
  description.usage |= VK_IMAGE_USAGE_SAMPLED_BIT;
  description.layers = cascade_count;
  description.array = true;
  targets.shadow_map = create_image(memory, description);
}

void destroy_frame_targets(FrameTargets& targets, vulkan::MemoryPool& memory) {
  for (vulkan::DeviceImage* image : {&targets.samples, &targets.depth, &targets.drawn, &targets.picture, &targets.shadow_map})
    destroy_image(memory, *image);
  targets = {};
}

void begin_view_rendering(PassContext& context, const FrameTargets& targets) {
  VkRenderingAttachmentInfo color{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  color.imageView = targets.smoothed() ? targets.drawn.view : targets.picture.view;
  color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  if (targets.multisampled()) {
    color.imageView = targets.samples.view;
    color.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    color.resolveImageView = targets.picture.view;
    color.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    color.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  }
  color.clearValue.color = {{0.0f, 0.0f, 0.0f, 1.0f}};
  VkRenderingAttachmentInfo depth{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  depth.imageView = targets.depth.view;
  depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
  depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  depth.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  depth.clearValue.depthStencil = {0.0f, 0};
  VkRenderingInfo rendering{VK_STRUCTURE_TYPE_RENDERING_INFO};
  rendering.renderArea = {{0, 0}, {targets.width, targets.height}};
  rendering.layerCount = 1;
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachments = &color;
  rendering.pDepthAttachment = &depth;
  vkCmdBeginRendering(context.slot.commands, &rendering);
}

void clear_inset(PassContext& context, const FrameTargets& targets, const PixelRectangle& rectangle) {
  constexpr std::int32_t rim_px = 3;
  const std::int32_t left = std::max(0, rectangle.x - rim_px), top = std::max(0, rectangle.y - rim_px);
  const std::int32_t right = std::min(std::int32_t(targets.width), rectangle.x + std::int32_t(rectangle.width) + rim_px);
  const std::int32_t bottom = std::min(std::int32_t(targets.height), rectangle.y + std::int32_t(rectangle.height) + rim_px);
  VkClearAttachment rim{};
  rim.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT;
  rim.clearValue.color = {{0.05f, 0.05f, 0.055f, 1.0f}};
  const VkClearRect around{{{left, top}, {std::uint32_t(right - left), std::uint32_t(bottom - top)}}, 0, 1};
  vkCmdClearAttachments(context.slot.commands, 1, &rim, 1, &around);
  VkClearAttachment clear{};
  clear.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT;
  clear.clearValue.depthStencil = {0.0f, 0};
  const VkClearRect area{{{rectangle.x, rectangle.y}, {rectangle.width, rectangle.height}}, 0, 1};
  vkCmdClearAttachments(context.slot.commands, 1, &clear, 1, &area);
}

void upload_texels(PassContext& context, const vulkan::DeviceImage& image, std::span<const std::byte> texels) {
  const FrameData data = store(context, texels);
  VkBufferImageCopy region{};
  region.bufferOffset = data.offset;
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = {image.description.width, image.description.height, 1};
  vkCmdCopyBufferToImage(context.slot.commands, data.buffer, image.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

void read_picture(const FrameTargets& targets, const vulkan::Device& device, vulkan::MemoryPool& memory,
                  std::span<std::uint8_t> rgba) {
  SEPTET_CHECK(rgba.size() == std::size_t{4} * targets.width * targets.height, "{} bytes", rgba.size());
  struct Owned {
    vulkan::MemoryPool& memory;
    vulkan::Buffer buffer;
    ~Owned() { destroy_buffer(memory, buffer); }
  } owned{memory, create_buffer(memory, rgba.size(), VK_BUFFER_USAGE_TRANSFER_DST_BIT, vulkan::MemoryUse::read_by_host)};
  run_once(device, [&](VkCommandBuffer commands) {
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = {targets.width, targets.height, 1};
    vkCmdCopyImageToBuffer(commands, targets.picture.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, owned.buffer.buffer, 1,
                           &region);
    VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
    VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    dependency.memoryBarrierCount = 1;
    dependency.pMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &dependency);
  });
  std::memcpy(rgba.data(), owned.buffer.mapped, rgba.size());
}

}  // namespace septet::render
