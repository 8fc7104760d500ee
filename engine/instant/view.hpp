#pragma once
/// View into the world: its rectangle of a target, and the rays of its pixels.

#include <cstdint>

#include <glm/vec3.hpp>

#include "engine/instant/off_axis_view.hpp"
#include "engine/math/rigid_transform.hpp"

namespace septet::instant {

/// Rectangle of the target, pixels, from the upper left.
struct PixelRectangle {
  std::int32_t x = 0, y = 0;
  std::uint32_t width = 0, height = 0;
};

/// One view into the world. A frame draws its views in order; a later one lies over an earlier one (mirror insets).
struct FrameView {
  OffAxisView projection;
  RigidTransform world_from_car;
  Vec3 velocity_mps{0.0};  ///< Velocity of the eye, world frame: rain falls past it.
  PixelRectangle viewport;
  bool mirrored = false;  ///< Left and right are exchanged, as by a mirror.
  bool housed = false;    ///< Mirror picture over another view, with its housing drawn around.
};

/// Eye of a view, world.
Vec3 world_eye(const FrameView& view);

}  // namespace septet::instant
