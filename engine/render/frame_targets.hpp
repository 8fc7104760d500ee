#pragma once
/// The images that a frame is drawn into, and how they are cleared, filled and read.

#include <span>
#include <vector>

#include "engine/render/passes/pass_context.hpp"

namespace septet::render {

struct FrameTargets {
  std::uint32_t width = 0, height = 0;
  vulkan::DeviceImage samples;  ///< Four colours a pixel; absent without multisampling.
  vulkan::DeviceImage depth;
  vulkan::DeviceImage drawn;    ///< One colour a pixel, before smoothing; absent without it.
  vulkan::DeviceImage picture;  ///< The finished frame, sRGB codes.
  vulkan::DeviceImage shadow_map;
  /// How each was left by the last frame.
  Access samples_access = Access::none, depth_access = Access::none, drawn_access = Access::none,
         picture_access = Access::none, shadow_access = Access::none;

  bool multisampled() const { return samples.image != VK_NULL_HANDLE; }
  bool smoothed() const { return drawn.image != VK_NULL_HANDLE; }
};

void create_frame_targets(FrameTargets& targets, vulkan::MemoryPool& memory, const TargetFormats& formats,
                          std::uint32_t width, std::uint32_t height, bool smoothed);
void destroy_frame_targets(FrameTargets& targets, vulkan::MemoryPool& memory);

/// Begins drawing into all of the target, cleared to an empty depth.
void begin_view_rendering(PassContext& context, const FrameTargets& targets);
/// Empties the depth of a part of the target, for a view that lies over another, and draws a dark rim around it.
void clear_inset(PassContext& context, const FrameTargets& targets, const PixelRectangle& rectangle);

/// Replaces an image's texels by way of the frame's arena.
void upload_texels(PassContext& context, const vulkan::DeviceImage& image, std::span<const std::byte> texels);
/// Waits, and copies the picture's pixels.
void read_picture(const FrameTargets& targets, const vulkan::Device& device, vulkan::MemoryPool& memory,
                  std::span<std::uint8_t> rgba);

}  // namespace septet::render
