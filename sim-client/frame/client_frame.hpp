#pragma once
/// Frame of one screen, or of a film's camera, from an instant of the world: the last stage before the GPU.
///
/// Pure, as is every function of this header: the same snapshot, views and scene give the same frame, for a live
/// screen, a replay, a film and a test alike. Effects are not part of it: debris, dents, ice, glass, smoke and soot are
/// added by EffectsDrawing::add_to (effects_drawing.hpp), which caches decoded keyframes and what it last showed, so
/// they depend on its latest `show` and on the keyframes at hand.

#include <vector>

#include "engine/core/expected.hpp"
#include "engine/instant/frame_input.hpp"
#include "engine/rig/rig.hpp"
#include "engine/scene/resolved_scene.hpp"
#include "engine/world/snapshot.hpp"
#include "sim-client/frame/mirror_drawing.hpp"
#include "sim-client/frame/viewpoint.hpp"

namespace septet::frame {

/// Views of a screen, with projections from the eyes' place; or a camera's views.
struct ScreenViews {
  std::vector<instant::FrameView> views;
  std::vector<SeenMirror> mirrors;  ///< Mirrors at their places, if the car's inside is drawn.
  bool show_interior = false;
  /// The only view is of the instruments' panel, which fills it as far as its shape allows.
  bool only_instruments = false;
};

/// Views of a screen, a window for eyes at `head`; if the head frame is turned, the window turns with it. Mirrors stay
/// at the car's places; an inset shows one while this screen does not see it at its place, above the dials if it would
/// cover them. Error: a screen that the eyes do not see from its front.
Expected<ScreenViews> screen_views(const rig::Rig& rig, const rig::Screen& screen, const Head& head = {});

/// Frame of `shown` from a viewpoint, in whose frame the views are given.
instant::FrameInput client_frame(const Snapshot& shown, const ScreenViews& views, const Viewpoint& viewpoint,
                                 const scene::ResolvedScene& scene);

/// Line across the middle of the picture, for a message that the driver must read ("server lost").
instant::OverlayText banner(std::string text, const rig::Screen& screen);

}  // namespace septet::frame
