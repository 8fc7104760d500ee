#pragma once
/// Temporal anti-aliasing: each frame samples its pixels at another offset, and static surfaces keep the samples of the
/// frames before.
///
/// Information that a driver acts on is never of an earlier frame. The radiance's alpha marks moving surfaces:
/// participants and loose objects, the cores of glows, thick smoke, rain, mirrors, ice. A pixel with any of these, or
/// with any at its place in the frame before, shows the current frame alone; such surfaces are not shifted by the
/// samples' offset. In other pixels the earlier colour is clamped to the range of the nine pixels around (Karis, "High
/// Quality Temporal Supersampling", 2014), so that a shadow, a beam of light or a reflection in a wet road leaves no
/// trail: no colour is shown that is not there within a pixel.
///
/// The place of a pixel in the frame before follows from its depth and both views. No history is used after a leap of
/// time or place, or in another scene.

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
  double kept_depth = 1.0;  ///< See view_uniforms.hpp.
  PixelRectangle viewport;
};

/// Views, time and scene of an earlier frame.
struct SeenFrame {
  std::vector<SeenView> views;
  double simulated_time_s = 0.0;
  std::uint64_t scene_revision = 0;
};

struct TemporalPass {
  VkPipeline pipeline = VK_NULL_HANDLE;
  std::array<vulkan::DeviceImage, 2>
      images;  ///< Frame before and this one, by turns: radiance, with the marks in alpha.
  std::array<Access, 2> accesses{};
  std::uint32_t frame = 0;          ///< Number of consecutive frames.
  std::optional<SeenFrame> before;  ///< Empty: nothing has been drawn since the images were created.

  bool present() const { return pipeline != VK_NULL_HANDLE; }
};

void create_temporal_pass(TemporalPass& pass, const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                          const TargetFormats& formats);
void create_temporal_targets(TemporalPass& pass, vulkan::MemoryPool& memory, const TargetFormats& formats,
                             std::uint32_t width, std::uint32_t height);
void destroy_temporal_targets(TemporalPass& pass, vulkan::MemoryPool& memory);
void destroy_temporal_pass(TemporalPass& pass, const vulkan::Device& device, vulkan::MemoryPool& memory);

/// Sample position of a frame relative to the pixels' centres: within half a pixel, evenly (Halton, 1960), eight
/// positions in turn.
glm::vec2 sample_offset_px(std::uint32_t frame);

SeenFrame seen_frame(const Instant& instant, std::uint64_t scene_revision);
/// True if the history of `before` may be used in the frame `now`.
bool leads_to(const SeenFrame& before, const SeenFrame& now);
/// Drops the history if it does not lead to `now`. Returns the sample offset of the frame to be drawn.
glm::vec2 begin_frame(TemporalPass& pass, const SeenFrame& now);

/// Adds the passes that blend the targets' radiance, with the views drawn into it, with the frame before, and keep the
/// result for the next frame. Their recording refers to all arguments.
void add_temporal_passes(FrameGraph& graph, TemporalPass& pass, PassContext& context, FrameTargets& targets,
                         ResourceId radiance, ResourceId depth, SeenFrame now, float exposure);

}  // namespace septet::render
