#pragma once
/// Temporal anti-aliasing: each frame takes one sample of a pixel elsewhere, and what stands still keeps what the frames before have seen of it.
///
/// What a driver acts on is never of a frame before. The radiance's alpha marks what does not stand still: participants and what is loose, the cores of
/// glows, thick smoke, rain, mirrors, ice. Where a pixel has any of that, or had it where it was seen in the frame before, the frame alone counts; such things
/// are not shifted by the samples' offset. Elsewhere what was seen before is brought between the least and the most of the nine pixels around
/// (Karis, "High Quality Temporal Supersampling", 2014), so that a shadow, a beam of light or what a wet road mirrors leaves no trail: nothing
/// is shown that is not there within a pixel.
///
/// Where a pixel was seen before follows from its depth and both views. Nothing is taken over after a leap of time or place, or into another scene.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include "engine/instant/instant.hpp"
#include "engine/render/passes/frame_graph.hpp"
#include "engine/render/passes/frame_targets.hpp"
#include "engine/render/passes/pass_context.hpp"

namespace septet::render {

struct SeenView {
  glm::dmat4 clip_from_relative{1.0};
  Vec3 eye_m{0.0};          ///< World.
  double kept_depth = 1.0;  ///< As view_uniforms.hpp has it.
  PixelRectangle viewport;
};

/// What the frame before has left.
struct SeenFrame {
  std::vector<SeenView> views;
  double simulated_time_s = 0.0;
  std::uint64_t scene_revision = 0;
};

struct TemporalPass {
  VkPipeline pipeline = VK_NULL_HANDLE;
  std::array<vulkan::DeviceImage, 2>
      images;  ///< Of the frame before and of this one, by turns: radiance, and in alpha the marks.
  std::array<Access, 2> accesses{};
  std::uint32_t frame = 0;          ///< Counts frames that follow each other.
  std::optional<SeenFrame> before;  ///< None: nothing has been drawn since the images were made.

  bool present() const { return pipeline != VK_NULL_HANDLE; }
};

void create_temporal_pass(TemporalPass& pass, const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                          const TargetFormats& formats);
void create_temporal_targets(TemporalPass& pass, vulkan::MemoryPool& memory, const TargetFormats& formats,
                             std::uint32_t width, std::uint32_t height);
void destroy_temporal_targets(TemporalPass& pass, vulkan::MemoryPool& memory);
void destroy_temporal_pass(TemporalPass& pass, const vulkan::Device& device, vulkan::MemoryPool& memory);

/// Where the frame's samples lie, from the middles of their pixels: within half a pixel, evenly (Halton, 1960), eight places in turn.
glm::vec2 sample_offset_px(std::uint32_t frame);

SeenFrame seen_frame(const Instant& instant, std::uint64_t scene_revision);
/// Whether what was seen then may be taken over into a frame that sees this.
bool leads_to(const SeenFrame& before, const SeenFrame& now);
/// Forgets what was seen if it does not lead there. Where the samples of the frame that is to be drawn lie.
glm::vec2 begin_frame(TemporalPass& pass, const SeenFrame& now);

/// Brings the targets' radiance, which the views have been drawn into, together with the frame before, and keeps it for the next one. What is recorded refers to all
/// of them.
void add_temporal_passes(FrameGraph& graph, TemporalPass& pass, PassContext& context, FrameTargets& targets,
                         ResourceId radiance, ResourceId depth, SeenFrame now, float exposure);

}  // namespace septet::render
