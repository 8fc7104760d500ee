#pragma once
/// The order of a frame: what each pass reads and writes, from the tables of light to the window.

#include <vector>

#include "engine/render/renderer_state.hpp"

namespace septet::render {

/// Draws and submits one frame and, with a window, presents it. `passing`: texts over all, which the picture that is read has not. Throws
/// vulkan::Failure.
void draw_frame(RendererState& state, const Instant& instant, const std::vector<OverlayText>& passing = {});

}  // namespace septet::render
