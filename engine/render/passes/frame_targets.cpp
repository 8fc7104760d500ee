#include "engine/render/passes/frame_targets.hpp"

#include <array>
#include <cstring>
#include <functional>

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
  description.format = formats.picture;
  description.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  targets.picture = create_image(memory, description);
  if (smoothed) {
    description.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    targets.mapped = create_image(memory, description);
  }
  description.format = formats.radiance;
  description.samples = formats.samples;
  description.usage =
      VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  if (formats.marks) description.usage |= VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  targets.radiance = create_image(memory, description);
  description.format = formats.depth;
  description.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  description.aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
  targets.depth = create_image(memory, description);
  description.width = description.height = cascade_texels;
  description.samples = VK_SAMPLE_COUNT_1_BIT;
  description.layers = cascade_count;
  description.array = true;
  targets.shadow_map = create_image(memory, description);
}

void create_kept_target(FrameTargets& targets, vulkan::MemoryPool& memory) {
  vulkan::ImageDescription description = targets.picture.description;
  description.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  targets.kept = create_image(memory, description);
}

void keep_picture(const FrameTargets& targets, PassContext& context) {
  VkImageCopy region{};
  region.srcSubresource = region.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.extent = {targets.width, targets.height, 1};
  vkCmdCopyImage(context.slot.commands, targets.picture.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, targets.kept.image,
                 VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

void destroy_frame_targets(FrameTargets& targets, vulkan::MemoryPool& memory) {
  for (vulkan::DeviceImage* image :
       {&targets.radiance, &targets.depth, &targets.mapped, &targets.picture, &targets.kept, &targets.shadow_map})
    destroy_image(memory, *image);
  targets = {};
}

void begin_view_rendering(PassContext& context, const vulkan::DeviceImage& target,
                          const vulkan::DeviceImage& depth_target, float alpha) {
  VkRenderingAttachmentInfo color{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  color.imageView = target.view;
  color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  color.clearValue.color = {{0.0f, 0.0f, 0.0f, alpha}};
  VkRenderingAttachmentInfo depth{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  depth.imageView = depth_target.view;
  depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
  depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  depth.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  depth.clearValue.depthStencil = {0.0f, 0};
  VkRenderingInfo rendering{VK_STRUCTURE_TYPE_RENDERING_INFO};
  rendering.renderArea = {{0, 0}, {target.description.width, target.description.height}};
  rendering.layerCount = 1;
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachments = &color;
  rendering.pDepthAttachment = &depth;
  vkCmdBeginRendering(context.slot.commands, &rendering);
}

void clear_inset(PassContext& context, const FrameTargets& targets, const FrameView& view) {
  const PixelRectangle& rectangle = view.viewport;
  const std::int32_t rim_px = view.housed ? 0 : 3;
  const std::int32_t left = std::max(0, rectangle.x - rim_px), top = std::max(0, rectangle.y - rim_px);
  const std::int32_t right =
      std::min(std::int32_t(targets.width), rectangle.x + std::int32_t(rectangle.width) + rim_px);
  const std::int32_t bottom =
      std::min(std::int32_t(targets.height), rectangle.y + std::int32_t(rectangle.height) + rim_px);
  VkClearAttachment rim{};
  rim.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT;
  rim.clearValue.color = {{0.0f, 0.0f, 0.0f, 1.0f}};
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
  vkCmdCopyBufferToImage(context.slot.commands, data.buffer, image.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                         &region);
}

namespace {

/// Waits for the device, and copies an image of one sample a pixel, a transfer source; `before` is recorded first.
void read_image(const vulkan::DeviceImage& image, const vulkan::Device& device, vulkan::MemoryPool& memory,
                std::span<std::byte> texels, const std::function<void(VkCommandBuffer)>& before) {
  struct Owned {
    vulkan::MemoryPool& memory;
    vulkan::Buffer buffer;
    ~Owned() { destroy_buffer(memory, buffer); }
  } owned{memory,
          create_buffer(memory, texels.size(), VK_BUFFER_USAGE_TRANSFER_DST_BIT, vulkan::MemoryUse::read_by_host)};
  run_once(device, [&](VkCommandBuffer commands) {
    before(commands);
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = {image.description.width, image.description.height, 1};
    vkCmdCopyImageToBuffer(commands, image.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, owned.buffer.buffer, 1,
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
  std::memcpy(texels.data(), owned.buffer.mapped, texels.size());
}

}  // namespace

void read_picture(const FrameTargets& targets, const vulkan::Device& device, vulkan::MemoryPool& memory,
                  std::span<std::uint8_t> rgba) {
  SEPTET_CHECK(rgba.size() == std::size_t{4} * targets.width * targets.height, "{} bytes", rgba.size());
  read_image(targets.is_kept ? targets.kept : targets.picture, device, memory, std::as_writable_bytes(rgba),
             [](VkCommandBuffer) {});
}

void read_radiance(FrameTargets& targets, const vulkan::Device& device, vulkan::MemoryPool& memory,
                   std::span<std::uint64_t> rgba) {
  SEPTET_CHECK(rgba.size() == std::size_t{targets.width} * targets.height, "{} texels", rgba.size());
  const auto texels = std::as_writable_bytes(rgba);
  const vulkan::ImageBarrier source{&targets.radiance, VK_NULL_HANDLE, targets.radiance_access, Access::transfer_source,
                                    false};
  targets.radiance_access = Access::transfer_source;
  if (targets.radiance.description.samples == VK_SAMPLE_COUNT_1_BIT) {
    read_image(targets.radiance, device, memory, texels, [&](VkCommandBuffer commands) {
      vulkan::record_barriers(commands, {&source, 1});
    });
    return;
  }
  struct Owned {
    vulkan::MemoryPool& memory;
    vulkan::DeviceImage image;
    ~Owned() { destroy_image(memory, image); }
  };
  vulkan::ImageDescription description = targets.radiance.description;
  description.samples = VK_SAMPLE_COUNT_1_BIT;
  description.usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  const Owned mean{memory, create_image(memory, description)};
  read_image(mean.image, device, memory, texels, [&](VkCommandBuffer commands) {
    vulkan::ImageBarrier target{&mean.image, VK_NULL_HANDLE, Access::none, Access::transfer_destination, true};
    const std::array barriers{source, target};
    vulkan::record_barriers(commands, barriers);
    VkImageResolve region{};
    region.srcSubresource = region.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.extent = {targets.width, targets.height, 1};
    vkCmdResolveImage(commands, targets.radiance.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, mean.image.image,
                      VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
    target = {&mean.image, VK_NULL_HANDLE, Access::transfer_destination, Access::transfer_source, false};
    vulkan::record_barriers(commands, {&target, 1});
  });
}

}  // namespace septet::render
