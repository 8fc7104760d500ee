#pragma once
/// Images that a frame is drawn into, with their clearing, filling and reading.

#include <span>
#include <vector>

#include "engine/render/passes/pass_context.hpp"

namespace septet::render {

struct FrameTargets {
  std::uint32_t width = 0, height = 0;
  /// Radiance of the views, linear, before exposure; four samples a pixel with multisampling.
  vulkan::DeviceImage radiance, depth;
  vulkan::DeviceImage mapped;   ///< Display codes before smoothing; absent without smoothing.
  vulkan::DeviceImage picture;  ///< Finished frame, display codes.
  vulkan::DeviceImage kept;     ///< Finished frame without passing texts; absent until there are such texts.
  bool is_kept = false;         ///< True if the last frame filled `kept`.
  vulkan::DeviceImage shadow_map;
  /// Last access of each image in the last frame.
  Access radiance_access = Access::none, depth_access = Access::none, mapped_access = Access::none,
         picture_access = Access::none, kept_access = Access::none, shadow_access = Access::none;

  bool smoothed() const { return mapped.image != VK_NULL_HANDLE; }
};

void create_frame_targets(FrameTargets& targets, vulkan::MemoryPool& memory, const TargetFormats& formats,
                          std::uint32_t width, std::uint32_t height, bool smoothed);
/// Creates `kept`, of the picture's size.
void create_kept_target(FrameTargets& targets, vulkan::MemoryPool& memory);
void destroy_frame_targets(FrameTargets& targets, vulkan::MemoryPool& memory);

/// Begins drawing into all of a target and its depth, cleared to black with this alpha and to an empty depth.
void begin_view_rendering(PassContext& context, const vulkan::DeviceImage& target,
                          const vulkan::DeviceImage& depth_target, float alpha = 1.0f);
/// Clears the depth of a part of the target, for a view that lies over another, and draws a black rim around one
/// without a housing.
void clear_inset(PassContext& context, const FrameTargets& targets, const FrameView& view);

/// Replaces an image's texels by way of the frame's arena.
void upload_texels(PassContext& context, const vulkan::DeviceImage& image, std::span<const std::byte> texels);
/// Copies the picture, a transfer source, into `kept`, a transfer destination.
void keep_picture(const FrameTargets& targets, PassContext& context);
/// Waits for the device, and copies the picture's pixels, without passing texts.
void read_picture(const FrameTargets& targets, const vulkan::Device& device, vulkan::MemoryPool& memory,
                  std::span<std::uint8_t> rgba);
/// Waits for the device, and copies the radiance as half floats, the mean of its samples; changes radiance_access.
void read_radiance(FrameTargets& targets, const vulkan::Device& device, vulkan::MemoryPool& memory,
                   std::span<std::uint64_t> rgba);

}  // namespace septet::render
