#include "engine/instant/off_axis_view.hpp"

#include <cmath>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "engine/core/check.hpp"

namespace septet::instant {
namespace {

constexpr double largest_cosine_between_edges = 0.0017;  // 0.1° from a right angle.

void set_clip_matrix(OffAxisView& view) {
  const double width = view.right_slope - view.left_slope;
  const double height = view.top_slope - view.bottom_slope;
  // Rows of P · Mᵀ: x right, y up and z back are dot products with the screen's axes.
  const Vec3 x = (2.0 / width) * view.right + ((view.right_slope + view.left_slope) / width) * view.back;
  const Vec3 y = -(2.0 / height) * view.up - ((view.top_slope + view.bottom_slope) / height) * view.back;
  const Vec3 w = -view.back;
  view.clip_from_eye_relative = glm::dmat4(glm::dvec4(x.x, y.x, 0.0, w.x), glm::dvec4(x.y, y.y, 0.0, w.y),
                                           glm::dvec4(x.z, y.z, 0.0, w.z), glm::dvec4(0.0, 0.0, view.near_m, 0.0));
}

}  // namespace

Expected<OffAxisView> off_axis_view(const ScreenCorners& corners, const Vec3& eye_m, double near_m) {
  SEPTET_CHECK(near_m > 0.0, "near plane at {} m", near_m);
  const Vec3 along = corners.lower_right_m - corners.lower_left_m;
  const Vec3 upward = corners.upper_left_m - corners.lower_left_m;
  const double width_m = glm::length(along), height_m = glm::length(upward);
  if (!(width_m > 1e-6) || !(height_m > 1e-6) || !std::isfinite(width_m) || !std::isfinite(height_m))
    return failure(fmt::format("the screen is {} m wide and {} m high", width_m, height_m), "screen corners",
                   "give three different corners of a rectangle");
  OffAxisView view;
  view.eye_m = eye_m;
  view.near_m = near_m;
  view.right = along / width_m;
  view.up = upward / height_m;
  if (const double cosine = glm::dot(view.right, view.up); std::abs(cosine) > largest_cosine_between_edges)
    return failure(fmt::format("the screen's edges meet at {:.2f}°", std::acos(cosine) * 180.0 / M_PI),
                   "screen corners", "give the corners of a rectangle, so that its edges meet at 90°");
  view.back = glm::normalize(glm::cross(view.right, view.up));
  view.up = glm::cross(view.back, view.right);

  const Vec3 to_lower_left = corners.lower_left_m - eye_m;
  const double distance_m = -glm::dot(to_lower_left, view.back);
  if (!(distance_m > 1e-6))
    return failure(fmt::format("the eye is {:.3f} m behind the screen", -distance_m), "screen corners",
                   "order the corners as the viewer sees them, and put the eye in front of the screen");
  view.left_slope = glm::dot(view.right, to_lower_left) / distance_m;
  view.right_slope = glm::dot(view.right, corners.lower_right_m - eye_m) / distance_m;
  view.bottom_slope = glm::dot(view.up, to_lower_left) / distance_m;
  view.top_slope = glm::dot(view.up, corners.upper_left_m - eye_m) / distance_m;
  set_clip_matrix(view);
  return view;
}

OffAxisView symmetric_view(const Vec3& eye_m, double heading_rad, double pitch_rad, double horizontal_angle_rad,
                           double vertical_angle_rad, double near_m) {
  SEPTET_CHECK(horizontal_angle_rad > 0.0 && horizontal_angle_rad < M_PI, "angle {}", horizontal_angle_rad);
  SEPTET_CHECK(vertical_angle_rad > 0.0 && vertical_angle_rad < M_PI, "angle {}", vertical_angle_rad);
  OffAxisView view;
  view.eye_m = eye_m;
  view.near_m = near_m;
  const Quat orientation = orientation_from_angles(heading_rad, -pitch_rad, 0.0);
  view.right = orientation * Vec3(0, -1, 0);
  view.up = orientation * Vec3(0, 0, 1);
  view.back = orientation * Vec3(-1, 0, 0);
  view.right_slope = std::tan(horizontal_angle_rad / 2.0);
  view.top_slope = std::tan(vertical_angle_rad / 2.0);
  view.left_slope = -view.right_slope;
  view.bottom_slope = -view.top_slope;
  set_clip_matrix(view);
  return view;
}

}  // namespace septet::instant
