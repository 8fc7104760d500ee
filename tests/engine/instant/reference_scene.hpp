#pragma once
/// Small synthetic scene for tests and benchmarks of the renderer: a straight five-lane carriageway with markings and a
/// barrier, grass, hills, trees, a gantry, a stretch of tunnel, and a box of a car with wheels and lamps.
///
/// Everything is placed from `origin_m`, so that a test can put the world anywhere.

#include "engine/instant/frame_input.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::instant {

struct ReferenceScene {
  scene::ResolvedScene scene;
  std::uint32_t car_prototype = 0;
};

struct ReferenceOptions {
  Vec3 origin_m{0.0};
  bool tunnel = false;  ///< From 60 m to 260 m ahead.
  std::uint32_t trees = 600;
};

ReferenceScene reference_scene(const ReferenceOptions& options = {});

/// A participant of the reference scene's car at (x, y) from `origin_m`, driving along x.
DrawnParticipant reference_car(const ReferenceScene& reference, const Vec3& world_m);

/// Noon-ish light from the left behind.
Environment reference_day();

/// A view along x from 1.2 m over `car_m`, over the whole picture.
FrameView forward_view(const Vec3& car_m, std::uint32_t width, std::uint32_t height);

}  // namespace septet::instant
