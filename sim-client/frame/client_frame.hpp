#pragma once
/// From an instant of the world to what one screen, or a film's camera, draws of it: the last stage before the GPU.
///
/// Pure: the same snapshot, views and scene give the same frame, for a live screen, a replay, a film and a test alike.

#include <vector>

#include "engine/core/expected.hpp"
#include "engine/instant/frame_input.hpp"
#include "engine/rig/rig.hpp"
#include "engine/scene/resolved_scene.hpp"
#include "engine/world/snapshot.hpp"
#include "sim-client/frame/mirror_drawing.hpp"
#include "sim-client/frame/viewpoint.hpp"

namespace septet::frame {

/// A screen's views with their projections from where the eyes are. Or those of a camera.
struct ScreenViews {
  std::vector<instant::FrameView> views;
  std::vector<SeenMirror> mirrors;  ///< In their places, where the car's inside is drawn.
  bool show_interior = false;
  bool only_instruments = false;  ///< The one view is of the instruments' panel, filling it as far as its shape allows.
};

/// The screen is a window for eyes at `head`; where that is turned, the window has gone round with them. Mirrors stay where the car has
/// them; an inset shows one while this screen does not see it in its place, above the dials where it would lie on them. Refuses a screen that the eyes do not see from its front.
Expected<ScreenViews> screen_views(const rig::Rig& rig, const rig::Screen& screen, const Head& head = {});

/// `shown` as seen from a viewpoint, in whose frame the views are given.
instant::FrameInput client_frame(const Snapshot& shown, const ScreenViews& views, const Viewpoint& viewpoint,
                                 const scene::ResolvedScene& scene);

/// A line across the middle of the picture, for what the driver must know ("server lost").
instant::OverlayText banner(std::string text, const rig::Screen& screen);

}  // namespace septet::frame
