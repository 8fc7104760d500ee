#pragma once
/// Overlay: mirrors' housings, lines of text and the boxes behind them, over the finished picture.
///
/// Lines are rasterised on the CPU (engine/image) into one atlas, which is uploaded only for a new text; a full atlas
/// is cleared and begun anew.

#include <span>
#include <string>
#include <vector>

#include "engine/image/font.hpp"
#include "engine/light/records.hpp"
#include "engine/render/passes/pass_context.hpp"

namespace septet::render {

struct OverlayPass {
  VkPipeline pipeline = VK_NULL_HANDLE;
  image::Font font;
  vulkan::DeviceImage atlas;
  /// Entry of the atlas: a line's text, and its box.
  struct Line {
    std::string text;
    float height_px = 0.0f;
    std::uint32_t x = 0, y = 0, width = 0, height = 0;
  };
  std::vector<Line> lines;
  image::Image pixels;
  /// Place of the next line: lines stand side by side on shelves as high as their highest.
  std::uint32_t shelf_x = 0, shelf_y = 0, shelf_height = 0;
};

void create_overlay_pass(OverlayPass& pass, const vulkan::Device& device, vulkan::MemoryPool& memory,
                         const vulkan::PipelineLayout& layout, const TargetFormats& formats);
void destroy_overlay_pass(OverlayPass& pass, const vulkan::Device& device, vulkan::MemoryPool& memory);

/// Adds these texts to the atlas's pixels; true if the atlas must be uploaded. `any_below`: something is drawn below
/// the texts.
bool lay_out(OverlayPass& pass, const std::vector<OverlayText>& texts, bool any_below);
/// Copies the pixels to the atlas image, which is a transfer destination.
void upload_atlas(OverlayPass& pass, PassContext& context);
/// Draws into `target`, over its contents: first `below`, such as mirrors' housings, then the texts.
void draw_overlay(const OverlayPass& pass, PassContext& context, std::span<const light::QuadConstants> below,
                  const std::vector<OverlayText>& texts, VkImageView target, std::uint32_t width, std::uint32_t height);

}  // namespace septet::render
