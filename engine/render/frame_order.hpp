#pragma once
/// The order of a frame: what each pass reads and writes, from the tables of light to the window.

#include "engine/render/renderer_state.hpp"

namespace septet::render {

/// Draws and submits one frame and, with a window, presents it. Throws vulkan::Failure.
void draw_frame(RendererState& state, const Instant& instant);

}  // namespace septet::render
