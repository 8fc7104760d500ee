#pragma once
/// All screens of a rig at one tick, unrolled by angle into one picture.
///
/// Every direction from the eye point has its place: azimuth runs across (left of the car to the left of the picture),
/// elevation up, both at the same number of pixels a degree (equirectangular). Screens ahead form the upper row,
/// screens behind the lower one, as seen by a driver who turns round. Angles are radians in the car's frame.

#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/image/draw.hpp"
#include "engine/image/image.hpp"
#include "engine/math/rigid_transform.hpp"

namespace septet::image {

/// A flat screen by three of its corners in the car's frame, as the eye sees them, and its picture.
struct PanoramaScreen {
  std::string name;
  Vec3 lower_left_m, lower_right_m, upper_left_m;
  const Image* image = nullptr;  ///< Not owned; null draws the screen dark.
};

struct PanoramaView {
  Vec3 eye_point_m;
  std::vector<PanoramaScreen> screens;
  std::string title;                 ///< "motorway-ambulance".
  std::vector<std::string> details;  ///< "tick 1800", "15.00 s", one line each.
  double pixels_per_degree = 10.0;
};

/// One strip of the picture: a range of azimuth and elevation and its place.
struct PanoramaRow {
  std::vector<std::size_t> screens;  ///< Indices into PanoramaView::screens, from left to right.
  double left_azimuth_rad = 0.0;     ///< Azimuth of the left edge; azimuth falls to the right.
  double top_elevation_rad = 0.0;
  double left_px = 0.0, top_px = 0.0, width_px = 0.0, height_px = 0.0;
};

struct PanoramaLayout {
  double pixels_per_rad = 10.0 * 180.0 / std::numbers::pi;
  std::uint32_t width_px = 0, height_px = 0;
  std::vector<PanoramaRow> rows;
};

/// Place where the ray from the eye along `direction` meets the screen: (0, 0) upper left, (1, 1) lower right; empty
/// where it misses it.
std::optional<Point> screen_point(const PanoramaScreen& screen, const Vec3& eye_point_m, const Vec3& direction);

PanoramaLayout layout_panorama(const PanoramaView& view);

/// The pixel of `row` that shows this direction (it may lie outside of the row).
Point panorama_pixel(const PanoramaLayout& layout, const PanoramaRow& row, const Vec3& direction);

/// The picture, with names, angles, title and a plan of the screens. Error: the font is missing.
Expected<Image> unroll(const PanoramaView& view);

}  // namespace septet::image
