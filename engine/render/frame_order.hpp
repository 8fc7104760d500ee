#pragma once
/// Order of a frame: reads and writes of each pass, from the tables of light to the window.

#include <vector>

#include "engine/render/renderer_state.hpp"

namespace septet::render {

/// Draws and submits one frame and, with a window, presents it. `passing`: texts drawn last, on the window only;
/// read-back omits them. Throws vulkan::Failure.
void draw_frame(RendererState& state, const Instant& instant, const std::vector<OverlayText>& passing = {});

}  // namespace septet::render
