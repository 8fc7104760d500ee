#pragma once
/// Bloom: light that the eye's own media, or a lens, scatter around bright areas. No threshold: each pixel gives away
/// the same share of its light.
///
/// The radiance is halved level by level, and from the smallest level up each is mixed into the next larger one, the
/// last into the radiance itself: a point spread with a bright middle and wide skirts that conserves light. Lamps whose
/// glare informs the driver have it without bloom (glow_pass.hpp): nothing that the driver acts on depends on this
/// pass.

#include <array>

#include "engine/render/passes/frame_graph.hpp"

namespace septet::render {

inline constexpr std::size_t bloom_levels = 5;

struct BloomPass {
  /// Downsampling: from the radiance, and from level to level.
  VkPipeline first = VK_NULL_HANDLE, down = VK_NULL_HANDLE;
  VkPipeline up = VK_NULL_HANDLE, last = VK_NULL_HANDLE;  ///< Upsampling: from level to level, and into the radiance.
  std::array<vulkan::DeviceImage, bloom_levels> images;   ///< Half of the target, a quarter, …
  std::array<Access, bloom_levels> accesses{};

  bool present() const { return first != VK_NULL_HANDLE; }
};

void create_bloom_pass(BloomPass& pass, const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                       const TargetFormats& formats);
/// Creates the images for a target of this size, replacing earlier ones.
void create_bloom_targets(BloomPass& pass, vulkan::MemoryPool& memory, const TargetFormats& formats,
                          std::uint32_t width, std::uint32_t height);
void destroy_bloom_targets(BloomPass& pass, vulkan::MemoryPool& memory);
void destroy_bloom_pass(BloomPass& pass, const vulkan::Device& device, vulkan::MemoryPool& memory);

/// Adds all passes from the finished radiance, which is `target`, to the radiance with its bloom.
void add_bloom_passes(FrameGraph& graph, BloomPass& pass, PassContext& context, ResourceId radiance,
                      const vulkan::DeviceImage& target);

}  // namespace septet::render
