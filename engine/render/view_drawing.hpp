#pragma once
/// What is drawn of a view, in order: opaque surfaces, ones with holes, stripes, sky, what one sees through, lights, weather.

#include <span>

#include "engine/render/frame_preparation.hpp"
#include "engine/render/renderer_state.hpp"

namespace septet::render {

/// Of any view: all but its uniforms and what the road mirrors.
ViewBindings view_bindings(const RendererState& state);
SurfaceLight surface_light(const Instant& instant, bool lit_by_headlights, bool lit_by_lamps);

/// The frame's views into the radiance, the later ones over the first.
void draw_views(RendererState& state, PassContext& context, const PreparedFrame& frame, const Instant& instant);
/// What is seen in the cockpit's mirrors, into their picture.
void draw_mirrors(RendererState& state, PassContext& context, const PreparedFrame& frame, const Instant& instant);
/// What lies around ice, six views, into the picture from which its cube map is made.
void draw_surroundings(RendererState& state, PassContext& context, std::span<const PreparedView> views,
                       const Instant& instant);

}  // namespace septet::render
