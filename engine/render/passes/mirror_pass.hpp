#pragma once
/// The car's mirrors in their places (engine/instant/mirror_glass.hpp): what is seen in them, and their glass in the first view.
///
/// What all of them show is drawn first, into one picture of radiance that holds a rectangle for each; then the glass is drawn among the
/// opaque surfaces of the view, its corners taking what they show from there. Ice to look through is left out of mirrors.

#include <span>

#include "engine/instant/mirror_glass.hpp"
#include "engine/render/passes/pass_context.hpp"

namespace septet::render {

struct MirrorPass {
  VkPipeline pipeline = VK_NULL_HANDLE;
  vulkan::DeviceImage picture;  ///< One sample a pixel.
  vulkan::DeviceImage samples;  ///< With multisampling what is drawn into, and averaged; else a texel.
  vulkan::DeviceImage depth;
  Access picture_access = Access::none, samples_access = Access::none, depth_access = Access::none;
  bool multisampled() const { return depth.description.samples != VK_SAMPLE_COUNT_1_BIT; }
};

/// The triangles of all glasses.
struct PreparedGlass {
  FrameData corners;
  std::uint32_t count = 0;  ///< Of corners.
};

void create_mirror_pass(MirrorPass& pass, const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                        const TargetFormats& formats);
void destroy_mirror_pass(MirrorPass& pass, const vulkan::Device& device, vulkan::MemoryPool& memory);

/// Whether the images hold the pictures of these mirrors.
bool mirrors_fit(const MirrorPass& pass, std::span<const instant::MirrorGlass> mirrors);
/// Makes them anew, with room to spare. No frame that uses them may be in flight.
void prepare_mirror_targets(MirrorPass& pass, vulkan::MemoryPool& memory, const TargetFormats& formats,
                            std::span<const instant::MirrorGlass> mirrors);
/// Begins drawing what is seen in them, all dark so far.
void begin_mirror_rendering(const MirrorPass& pass, PassContext& context,
                            std::span<const instant::MirrorGlass> mirrors);

/// Glass that an eye at `eye_m` sees, world.
PreparedGlass prepare_mirror_glass(PassContext& context, std::span<const instant::MirrorGlass> mirrors,
                                   const Vec3& eye_m);
/// Into the view that is being drawn; it leaves other records bound.
void draw_mirror_glass(const MirrorPass& pass, PassContext& context, const PreparedGlass& glass);

}  // namespace septet::render
