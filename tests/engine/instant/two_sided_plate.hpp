#pragma once
/// A plate standing upright before the eye, facing it with its front or its back.

#include <cstdint>

#include "engine/instant/frame_input.hpp"
#include "engine/instant/off_axis_view.hpp"
#include "tests/engine/instant/lone_mesh.hpp"

namespace septet::instant {

struct PlateLook {
  bool two_sided = false, from_behind = false, in_a_mirror = false;
  float opacity = 1.0f;
  bool holes = false;
};

/// Sun from behind the eye and above, as long as the sky is clear.
inline Environment plate_day() {
  Environment day;
  day.sun_azimuth_rad = 1.5 * 3.14159265358979;  // West; the eye looks east.
  day.sun_elevation_rad = 0.6;
  return day;
}

inline FrameView plate_view(std::uint32_t size_px) {
  FrameView view;
  view.projection = symmetric_view({0.0, 0.0, 1.2}, 0.0, 0.0, 0.6, 0.6);
  view.viewport = {0, 0, size_px, size_px};
  return view;
}

/// Plate 8 m before the eye of plate_view, 6 m wide; `there` false: far below the ground.
inline scene::ResolvedScene plate_scene(const PlateLook& look, bool there) {
  scene::SurfaceMaterial red;
  red.base_color = {0.5f, 0.05f, 0.04f};
  red.roughness = 0.9f;
  red.opacity = look.opacity;
  red.two_sided = look.two_sided;
  scene::SurfaceMesh plate;
  const float side = look.from_behind ? -1.0f : 1.0f;
  // The front looks to the west, where the eye is.
  for (const glm::vec2 at : {glm::vec2(3, -3), glm::vec2(-3, -3), glm::vec2(-3, 3), glm::vec2(3, 3)})
    plate.vertices.push_back({{0.0f, side * at.x, at.y}, {-side, 0, 0}, glm::vec2(0.25f)});
  plate.indices = {0, 1, 2, 0, 2, 3};
  scene::ResolvedScene scene = lone_mesh(red, plate, {Vec3(8.0, 0.0, there ? 1.2 : -500.0), {1, 0, 0, 0}});
  if (look.holes) {
    // One of its four texels is a hole; the plate shows another.
    scene.materials[0].base_color_image = 0;
    scene.images.push_back({.revision = 1,
                            .width = 2,
                            .height = 2,
                            .rgba = {255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 0}});
  }
  return scene;
}

}  // namespace septet::instant
