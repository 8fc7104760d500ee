#include "engine/render/passes/temporal_pass.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include "engine/light/records.hpp"
#include "engine/render/passes/shaders.hpp"
#include "engine/render/passes/view_uniforms.hpp"
#include "engine/render/passes/whole_target.hpp"

namespace septet::render {
namespace {

using light::ReprojectionConstants;
static_assert(sizeof(ReprojectionConstants) <= vulkan::push_constant_bytes);

constexpr double longest_step_s = 0.25, longest_way_m = 25.0;

float radical_inverse(std::uint32_t n, std::uint32_t base) {
  float value = 0.0f, share = 1.0f;
  for (; n > 0; n /= base) {
    share /= static_cast<float>(base);
    value += share * static_cast<float>(n % base);
  }
  return value;
}

/// Matrix between the clip spaces of both frames by way of world places; for a direction (depth 0) only the rotation
/// remains.
glm::mat4 before_from_now(const SeenView& before, const SeenView& now) {
  const glm::dmat4 eye_shift = glm::translate(glm::dmat4(1.0), glm::dvec3(now.eye_m - before.eye_m));
  const glm::dmat4 drawn = glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, 1.0, 1.0 / now.kept_depth));
  return glm::mat4(before.clip_from_relative * eye_shift * glm::inverse(now.clip_from_relative) * drawn);
}

void draw_resolved(const TemporalPass& pass, PassContext& context, const FrameTargets& targets, const SeenFrame& now,
                   float exposure) {
  const vulkan::DeviceImage &into = pass.images[pass.frame % 2], &from = pass.images[(pass.frame + 1) % 2];
  const VkCommandBuffer commands = context.slot.commands;
  VkRenderingAttachmentInfo color{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  color.imageView = into.view;
  color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  color.clearValue.color = {{0.0f, 0.0f, 0.0f, 1.0f}};
  VkRenderingInfo rendering{VK_STRUCTURE_TYPE_RENDERING_INFO};
  rendering.renderArea = {{0, 0}, {targets.width, targets.height}};
  rendering.layerCount = 1;
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachments = &color;
  vkCmdBeginRendering(commands, &rendering);
  vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
  vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pass.pipeline);
  push_image(context, targets.radiance.view, context.samplers.table);
  push_image(context, targets.depth.view, context.samplers.texel, vulkan::binding_depth);
  push_image(context, (pass.before ? from : targets.radiance).view, context.samplers.table, vulkan::binding_history);
  for (std::size_t n = 0; n < now.views.size(); ++n) {
    const SeenView& view = now.views[n];
    const PixelRectangle& at = view.viewport;
    set_viewport(context, at);
    ReprojectionConstants constants{
        glm::mat4(1.0f), {at.x, at.y, at.width, at.height}, {exposure, 0.0f, sample_offset_px(pass.frame)}};
    if (pass.before) {
      constants.before_from_now = before_from_now(pass.before->views[n], view);
      constants.more.y = 1.0f;
    }
    push_constants(context, std::as_bytes(std::span(&constants, 1)));
    vkCmdDraw(commands, 3, 1, 0, 0);
    ++context.statistics.draws;
    ++context.statistics.triangles;
  }
  vkCmdEndRendering(commands);
}

void copy_back(const TemporalPass& pass, PassContext& context, const FrameTargets& targets) {
  VkImageCopy region{};
  region.srcSubresource = region.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.extent = {targets.width, targets.height, 1};
  vkCmdCopyImage(context.slot.commands, pass.images[pass.frame % 2].image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                 targets.radiance.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

}  // namespace

void create_temporal_pass(TemporalPass& pass, const vulkan::Device& device, const vulkan::PipelineLayout& layout,
                          const TargetFormats& formats) {
  pass.pipeline =
      create_whole_target_pipeline(device, layout, formats.radiance, shaders::temporal_frag(), vulkan::Blend::data);
}

void create_temporal_targets(TemporalPass& pass, vulkan::MemoryPool& memory, const TargetFormats& formats,
                             std::uint32_t width, std::uint32_t height) {
  vulkan::ImageDescription description;
  description.width = width;
  description.height = height;
  description.format = formats.radiance;
  description.usage =
      VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  for (vulkan::DeviceImage& image : pass.images) image = create_image(memory, description);
  pass.accesses.fill(Access::none);
  pass.before.reset();
}

void destroy_temporal_targets(TemporalPass& pass, vulkan::MemoryPool& memory) {
  for (vulkan::DeviceImage& image : pass.images) destroy_image(memory, image);
}

void destroy_temporal_pass(TemporalPass& pass, const vulkan::Device& device, vulkan::MemoryPool& memory) {
  if (pass.pipeline) vkDestroyPipeline(device.device, pass.pipeline, nullptr);
  destroy_temporal_targets(pass, memory);
  pass = {};
}

glm::vec2 sample_offset_px(std::uint32_t frame) {
  const std::uint32_t n = frame % 8 + 1;
  return {radical_inverse(n, 2) - 0.5f, radical_inverse(n, 3) - 0.5f};
}

SeenFrame seen_frame(const Instant& instant, std::uint64_t scene_revision) {
  SeenFrame seen{{}, instant.simulated_time_s, scene_revision};
  seen.views.reserve(instant.views.size());
  for (const FrameView& view : instant.views)
    seen.views.push_back({clip_from_relative(view), world_eye(view), kept_depth(view), view.viewport});
  return seen;
}

bool leads_to(const SeenFrame& before, const SeenFrame& now) {
  const double step_s = now.simulated_time_s - before.simulated_time_s;
  if (before.scene_revision != now.scene_revision || !(step_s >= 0.0 && step_s <= longest_step_s)) return false;
  return std::equal(before.views.begin(), before.views.end(), now.views.begin(), now.views.end(),
                    [](const SeenView& a, const SeenView& b) {
                      const PixelRectangle &from = a.viewport, &to = b.viewport;
                      return from.x == to.x && from.y == to.y && from.width == to.width && from.height == to.height &&
                             glm::length(b.eye_m - a.eye_m) <= longest_way_m;
                    });
}

glm::vec2 begin_frame(TemporalPass& pass, const SeenFrame& now) {
  if (pass.before && !leads_to(*pass.before, now)) pass.before.reset();
  if (!pass.before) pass.frame = 0;
  return sample_offset_px(pass.frame);
}

void add_temporal_passes(FrameGraph& graph, TemporalPass& pass, PassContext& context, FrameTargets& targets,
                         ResourceId radiance, ResourceId depth, SeenFrame now, float exposure) {
  const std::size_t newest = pass.frame % 2, last = 1 - newest;
  const ResourceId resolved = graph.add_image("resolved frame", pass.images[newest], pass.accesses[newest]);
  std::vector<ResourceUse> reads{{radiance, Access::sampled}, {depth, Access::sampled}};
  if (pass.before)
    reads.push_back({graph.add_image("frame before", pass.images[last], pass.accesses[last]), Access::sampled});
  graph.add_pass("temporal", {reads, {{resolved, Access::color_attachment}}},
                 [&pass, &context, &targets, now, exposure] {
                   draw_resolved(pass, context, targets, now, exposure);
                   mark_pass(context, "temporal");
                 });
  graph.add_pass("resolved radiance",
                 {{{resolved, Access::transfer_source}}, {{radiance, Access::transfer_destination}}},
                 [&pass, &context, &targets, now = std::move(now)]() mutable {
                   copy_back(pass, context, targets);
                   mark_pass(context, "temporal");
                   pass.before = std::move(now);
                   ++pass.frame;
                 });
}

}  // namespace septet::render
