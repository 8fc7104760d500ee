#pragma once
/// View through a flat screen: the general off-axis perspective from the screen's corners and the eye.
///
/// Source: R. Kooima, "Generalized Perspective Projection" (2008): screen axes from the corners, slopes from the eye's
/// foot on the screen's plane. Deviations: depth is reversed with an infinite far plane (1 at the near plane, towards
/// 0), and y points down as in Vulkan. All values are double and relative to the eye, so that the distance of the
/// world's origin does not matter; only positions relative to the eye go to the GPU as float.

#include <glm/mat4x4.hpp>

#include "engine/core/expected.hpp"
#include "engine/math/rigid_transform.hpp"

namespace septet::instant {

/// Three corners of a rectangular screen as its viewer sees it, car frame, metres.
struct ScreenCorners {
  Vec3 lower_left_m{0.0}, lower_right_m{0.0}, upper_left_m{0.0};
};

/// Projection of one screen and one eye point.
struct OffAxisView {
  Vec3 eye_m{0.0};                      ///< Car frame.
  Vec3 right{0.0}, up{0.0}, back{0.0};  ///< Axes of the screen in the car frame; `back` points at the viewer.
  double left_slope = 0.0, right_slope = 0.0, bottom_slope = 0.0, top_slope = 0.0;  ///< Edges at distance 1.
  double near_m = 0.0;                                                              ///< Measured along −back.
  glm::dmat4 clip_from_eye_relative{1.0};  ///< Takes (point − eye), along the car's axes, to clip space.
};

/// View of `corners` from `eye_m`. Refuses an eye on or behind the screen, and corners that do not form a rectangle
/// (edges of no length or further than 0.1° from a right angle).
Expected<OffAxisView> off_axis_view(const ScreenCorners& corners, const Vec3& eye_m, double near_m = 0.15);

/// View of a free camera at `eye_m` that looks along `heading_rad`, `pitch_rad` (positive looks up) with these angles
/// across its width and height; for mirrors, films and pictures. Angles in (0, π), checked.
OffAxisView symmetric_view(const Vec3& eye_m, double heading_rad, double pitch_rad, double horizontal_angle_rad,
                           double vertical_angle_rad, double near_m = 0.15);

}  // namespace septet::instant
