#include "engine/render/passes/overlay_pass.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/render/passes/shaders.hpp"

namespace septet::render {
namespace {

constexpr std::uint32_t atlas_width = 1024, atlas_height = 512;
constexpr std::uint32_t padding = 2;
constexpr double em_per_line = 0.78;  // Ratio of the letters' size to the height of the line's box.

using light::QuadConstants;

glm::vec4 premultiplied(const glm::vec4& color) { return {glm::vec3(color) * color.a, color.a}; }

std::optional<OverlayPass::Line> find_line(const OverlayPass& pass, const OverlayText& text) {
  const auto found = std::find_if(pass.lines.begin(), pass.lines.end(), [&](const OverlayPass::Line& line) {
    return line.text == text.text && line.height_px == text.height_px;
  });
  return found == pass.lines.end() ? std::nullopt : std::optional(*found);
}

}  // namespace

void create_overlay_pass(OverlayPass& pass, const vulkan::Device& device, vulkan::MemoryPool& memory,
                         const vulkan::PipelineLayout& layout, const TargetFormats& formats) {
  vulkan::PipelineDescription description;
  description.vertex_code = shaders::overlay_vert();
  description.fragment_code = shaders::overlay_frag();
  description.vertex_input = vulkan::VertexInput::none;
  description.color_format = formats.picture;
  description.blend = vulkan::Blend::over;
  description.depth_write = false;
  pass.pipeline = create_pipeline(device, layout, description);
  vulkan::ImageDescription atlas;
  atlas.width = atlas_width;
  atlas.height = atlas_height;
  atlas.format = VK_FORMAT_R8G8B8A8_UNORM;
  atlas.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  pass.atlas = create_image(memory, atlas);
}

void destroy_overlay_pass(OverlayPass& pass, const vulkan::Device& device, vulkan::MemoryPool& memory) {
  if (pass.pipeline) vkDestroyPipeline(device.device, pass.pipeline, nullptr);
  pass.pipeline = VK_NULL_HANDLE;
  destroy_image(memory, pass.atlas);
}

namespace {

void clear(OverlayPass& pass) {
  pass.lines.clear();
  pass.pixels = image::Image(atlas_width, atlas_height, {255, 255, 255, 0});
  pass.shelf_x = pass.shelf_y = pass.shelf_height = 0;
}

/// Adds a line; false if the atlas has no room left for it.
bool add_line(OverlayPass& pass, const OverlayText& text) {
  const double size_px = text.height_px * em_per_line;
  OverlayPass::Line line{.text = text.text, .height_px = text.height_px};
  line.height = static_cast<std::uint32_t>(std::ceil(std::clamp(text.height_px, 4.0f, 200.0f)));
  line.width = std::min<std::uint32_t>(
      atlas_width, static_cast<std::uint32_t>(std::ceil(pass.font.width_px(text.text, size_px))) + 2 * padding);
  if (pass.shelf_x + line.width > atlas_width) {
    pass.shelf_y += pass.shelf_height;
    pass.shelf_x = pass.shelf_height = 0;
  }
  if (pass.shelf_y + line.height > atlas_height) return false;
  line.x = pass.shelf_x;
  line.y = pass.shelf_y;
  const double baseline = line.y + 0.5 * (text.height_px + pass.font.capital_height_px(size_px));
  pass.font.draw(pass.pixels, line.x + padding, std::round(baseline), text.text, size_px, {255, 255, 255, 255});
  pass.shelf_x += line.width + padding;
  pass.shelf_height = std::max(pass.shelf_height, line.height + padding);
  pass.lines.push_back(std::move(line));
  return true;
}

}  // namespace

bool lay_out(OverlayPass& pass, const std::vector<OverlayText>& texts, bool any_below) {
  const auto is_new = [&](const OverlayText& text) { return !find_line(pass, text).has_value(); };
  if (std::ranges::none_of(texts, is_new)) {
    if (!any_below || !pass.pixels.rgba.empty()) return false;
    clear(pass);  // The atlas is bound, so it must have been written once.
    return true;
  }
  if (pass.lines.empty()) clear(pass);
  const auto add_new = [&] {
    return std::ranges::all_of(texts, [&](const OverlayText& text) { return !is_new(text) || add_line(pass, text); });
  };
  if (add_new()) return true;
  // The atlas is full of texts that are no longer shown.
  clear(pass);
  if (add_new()) return true;
  // Texts that still find no room are noted as known, and empty.
  for (const OverlayText& text : texts)
    if (is_new(text)) pass.lines.push_back({.text = text.text, .height_px = text.height_px});
  return true;
}

void upload_atlas(OverlayPass& pass, PassContext& context) {
  const FrameData pixels = store(context, std::span<const std::uint8_t>(pass.pixels.rgba));
  VkBufferImageCopy region{};
  region.bufferOffset = pixels.offset;
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = {atlas_width, atlas_height, 1};
  vkCmdCopyBufferToImage(context.slot.commands, pixels.buffer, pass.atlas.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                         1, &region);
}

void draw_overlay(const OverlayPass& pass, PassContext& context, std::span<const QuadConstants> below,
                  const std::vector<OverlayText>& texts, VkImageView target, std::uint32_t width,
                  std::uint32_t height) {
  const VkCommandBuffer commands = context.slot.commands;
  VkRenderingAttachmentInfo color{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  color.imageView = target;
  color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  color.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  VkRenderingInfo rendering{VK_STRUCTURE_TYPE_RENDERING_INFO};
  rendering.renderArea = {{0, 0}, {width, height}};
  rendering.layerCount = 1;
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachments = &color;
  vkCmdBeginRendering(commands, &rendering);
  set_viewport(context, {0, 0, width, height});
  vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
  vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pass.pipeline);
  push_image(context, pass.atlas.view, context.samplers.table);
  const auto draw = [&](const QuadConstants& quad) {
    push_constants(context, std::as_bytes(std::span(&quad, 1)));
    vkCmdDraw(commands, 6, 1, 0, 0);
    ++context.statistics.draws;
    context.statistics.triangles += 2;
  };
  for (const QuadConstants& quad : below) draw(quad);
  const auto draw_quad = [&](float x, float y, float w, float h, const glm::vec4& uv, const glm::vec4& rgba,
                             float kind) {
    const float across = 2.0f / static_cast<float>(width), down = 2.0f / static_cast<float>(height);
    draw({{x * across - 1.0f, y * down - 1.0f, (x + w) * across - 1.0f, (y + h) * down - 1.0f},
          uv,
          premultiplied(rgba),
          {kind, 0.0f, 0.0f, 0.0f}});
  };
  for (const OverlayText& text : texts) {
    const OverlayPass::Line line = *find_line(pass, text);
    if (line.width == 0) continue;
    const auto w = static_cast<float>(line.width), h = static_cast<float>(line.height);
    // Whole pixels, so that letters stay as sharp as they were rasterised.
    const float x = std::round(text.x_px - (text.centered ? 0.5f * w : 0.0f));
    const float y = std::round(text.y_px - (text.centered ? 0.5f * h : 0.0f));
    const float margin = std::round(0.35f * text.height_px);
    if (text.background.a > 0.0f)
      draw_quad(x - margin, y - 2.0f, std::max(w + 2.0f * margin, text.least_box_px), h + 4.0f, glm::vec4(0.0f),
                text.background, 0.0f);
    const float left = static_cast<float>(line.x) / atlas_width, top = static_cast<float>(line.y) / atlas_height;
    draw_quad(x, y, w, h, {left, top, left + w / atlas_width, top + h / atlas_height}, text.color, 1.0f);
  }
  vkCmdEndRendering(commands);
}

}  // namespace septet::render
