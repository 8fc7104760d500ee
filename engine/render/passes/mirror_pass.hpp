#pragma once
/// Car mirrors in their places (engine/instant/mirror_glass.hpp): the views in them, and their glass in the first view.
///
/// All mirror views are drawn first, into one picture of radiance with a rectangle for each; then the glass is drawn
/// among the opaque surfaces of the view and samples that picture. Transparent ice is left out of mirrors.

#include <span>

#include "engine/instant/mirror_glass.hpp"
#include "engine/render/passes/pass_context.hpp"

namespace septet::render {

struct MirrorPass {
  VkPipeline pipeline = VK_NULL_HANDLE;
  vulkan::DeviceImage picture;  ///< One sample a pixel.
  /// Multisampled colour target, resolved into `picture`; one texel without multisampling.
  vulkan::DeviceImage samples;
  vulkan::DeviceImage depth;
  Access picture_access = Access::none, samples_access = Access::none, depth_access = Access::none;
  bool multisampled() const { return depth.description.samples != VK_SAMPLE_COUNT_1_BIT; }
};

/// Triangles of all glasses.
struct PreparedGlass {
  FrameData corners;
  std::uint32_t count = 0;  ///< Number of corners.
};

void create_mirror_pass(MirrorPass& pass, const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                        const TargetFormats& formats);
void destroy_mirror_pass(MirrorPass& pass, const vulkan::Device& device, vulkan::MemoryPool& memory);

/// True if the images are large enough for these mirrors.
bool mirrors_fit(const MirrorPass& pass, std::span<const instant::MirrorGlass> mirrors);
/// Creates the images anew, with room to spare. No frame that uses them may be in flight.
void prepare_mirror_targets(MirrorPass& pass, vulkan::MemoryPool& memory, const TargetFormats& formats,
                            std::span<const instant::MirrorGlass> mirrors);
/// Begins drawing the mirror views, cleared to black.
void begin_mirror_rendering(const MirrorPass& pass, PassContext& context,
                            std::span<const instant::MirrorGlass> mirrors);

/// Uploads the glass as an eye at `eye_m` (world) sees it.
PreparedGlass prepare_mirror_glass(PassContext& context, std::span<const instant::MirrorGlass> mirrors,
                                   const Vec3& eye_m);
/// Draws the glass into the current view; leaves other records bound.
void draw_mirror_glass(const MirrorPass& pass, PassContext& context, const PreparedGlass& glass);

}  // namespace septet::render
