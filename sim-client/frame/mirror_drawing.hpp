#pragma once
/// Mirrors of a car whose inside is drawn, in their places: glass, frame around it, and its stem or arm.

#include <vector>

#include "engine/instant/frame_input.hpp"
#include "engine/rig/rig.hpp"
#include "engine/scene/resolved_scene.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::frame {

/// Mirror of the rig that a screen sees.
struct SeenMirror {
  rig::Mirror mirror;
  instant::MirrorGlass glass;
};

/// Mirrors that `through`, the screen's view of this viewport, sees; insets only if wholly visible. Their pictures lie
/// one below the other in one texture.
std::vector<SeenMirror> seen_mirrors(const rig::Rig& rig, const rig::Screen& screen,
                                     const instant::OffAxisView& through, const instant::PixelRectangle& viewport);

/// Triangles of frame and holder, from the glass's middle along the car's axes: an inside mirror hangs from the head of
/// the windscreen, one outside stands on the door beside it.
std::vector<scene::SurfaceVertex> mirror_housing(const rig::Mirror& mirror);

/// Adds the mirrors to a frame in which the inside of the car is drawn, for eyes that move as the first view's do.
/// Without the scene's signs there is no housing.
void add_mirrors(instant::FrameInput& frame, const std::vector<SeenMirror>& mirrors, const scene::ResolvedScene& scene);

/// Adds the pictures in the mirrors of a vehicle that has mirrors of its own (engine/scenery/vehicles/vehicle_mirrors.hpp),
/// as far as the frame's first view sees them. Their glass and housings are parts of its inside.
void add_vehicle_mirrors(instant::FrameInput& frame, const Participant& vehicle);

}  // namespace septet::frame
