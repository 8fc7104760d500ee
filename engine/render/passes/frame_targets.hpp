#pragma once
/// The images that a frame is drawn into, and how they are cleared, filled and read.

#include <span>
#include <vector>

#include "engine/render/passes/pass_context.hpp"

namespace septet::render {

struct FrameTargets {
  std::uint32_t width = 0, height = 0;
  /// What the views give, linear, before exposure; with multisampling four samples a pixel.
  vulkan::DeviceImage radiance, depth;
  vulkan::DeviceImage mapped;   ///< The display's codes, before smoothing; absent without it.
  vulkan::DeviceImage picture;  ///< The finished frame, the display's codes.
  vulkan::DeviceImage kept;     ///< The same without passing texts; absent before there are any.
  bool is_kept = false;         ///< Whether the last frame has it.
  vulkan::DeviceImage shadow_map;
  /// How each was left by the last frame.
  Access radiance_access = Access::none, depth_access = Access::none, mapped_access = Access::none,
         picture_access = Access::none, kept_access = Access::none, shadow_access = Access::none;

  bool smoothed() const { return mapped.image != VK_NULL_HANDLE; }
};

void create_frame_targets(FrameTargets& targets, vulkan::MemoryPool& memory, const TargetFormats& formats,
                          std::uint32_t width, std::uint32_t height, bool smoothed);
/// `kept`, of the picture's size.
void create_kept_target(FrameTargets& targets, vulkan::MemoryPool& memory);
void destroy_frame_targets(FrameTargets& targets, vulkan::MemoryPool& memory);

/// Begins drawing into all of a target and its depth, cleared to darkness of this alpha and an empty depth.
void begin_view_rendering(PassContext& context, const vulkan::DeviceImage& target,
                          const vulkan::DeviceImage& depth_target, float alpha = 1.0f);
/// Empties the depth of a part of the target, for a view that lies over another, and draws a black rim around one that
/// is not housed.
void clear_inset(PassContext& context, const FrameTargets& targets, const FrameView& view);

/// Replaces an image's texels by way of the frame's arena.
void upload_texels(PassContext& context, const vulkan::DeviceImage& image, std::span<const std::byte> texels);
/// Copies the picture, a transfer source, into `kept`, a transfer destination.
void keep_picture(const FrameTargets& targets, PassContext& context);
/// Waits, and copies the picture's pixels; without passing texts.
void read_picture(const FrameTargets& targets, const vulkan::Device& device, vulkan::MemoryPool& memory,
                  std::span<std::uint8_t> rgba);
/// The same of the radiance, the mean of its samples, as half floats; it leaves its access changed.
void read_radiance(FrameTargets& targets, const vulkan::Device& device, vulkan::MemoryPool& memory,
                   std::span<std::uint64_t> rgba);

}  // namespace septet::render
