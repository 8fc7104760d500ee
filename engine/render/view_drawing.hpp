#pragma once
/// Drawing of a view, in order: opaque surfaces, ones with holes, stripes, contact shadows, sky, ice and glass,
/// transparent surfaces, wet lamps, smoke, glows, precipitation.

#include <span>

#include "engine/render/frame_preparation.hpp"
#include "engine/render/renderer_state.hpp"

namespace septet::render {

/// Bindings of any view, without its uniforms and the road's mirror image.
ViewBindings view_bindings(const RendererState& state);
SurfaceLight surface_light(const Instant& instant, bool lit_by_headlights, bool lit_by_lamps, bool smoke_shaded);

/// Draws the frame's views into the radiance, the later ones over the first.
void draw_views(RendererState& state, PassContext& context, const PreparedFrame& frame, const Instant& instant);
/// Draws the views of the cockpit's mirrors into their picture.
void draw_mirrors(RendererState& state, PassContext& context, const PreparedFrame& frame, const Instant& instant);
/// Draws the surroundings of ice, six views, into the picture from which its cube map is made.
void draw_surroundings(RendererState& state, PassContext& context, std::span<const PreparedView> views,
                       const Instant& instant);

}  // namespace septet::render
