#include <algorithm>
#include <cmath>

#include "engine/image/panorama.hpp"
#include "engine/math/angle_units.hpp"

namespace septet::image {
namespace {

/// A screen whose middle is further from straight ahead than this belongs to the row behind.
constexpr double ahead_limit_rad = 125.0 * radians_per_degree;
constexpr double margin_px = 44.0, label_above_px = 34.0, label_below_px = 40.0;

double azimuth_rad(const Vec3& direction) { return std::atan2(direction.y, direction.x); }
double elevation_rad(const Vec3& direction) { return std::atan2(direction.z, std::hypot(direction.x, direction.y)); }
/// `angle` plus whole turns, within half a turn of `near`.
double unwrapped(double angle, double near) {
  return angle - 2 * std::numbers::pi * std::round((angle - near) / (2 * std::numbers::pi));
}

Vec3 middle(const PanoramaScreen& screen) { return (screen.lower_right_m + screen.upper_left_m) / 2.0; }

/// The row of `screens` around `centre_rad`, its size from the screens' edges; its place is left open.
PanoramaRow measure_row(const PanoramaView& view, std::vector<std::size_t> screens, double centre_rad,
                        double pixels_per_rad) {
  double left = centre_rad, right = centre_rad, top = 0.0, bottom = 0.0;
  constexpr int steps = 16;
  for (const std::size_t index : screens) {
    const PanoramaScreen& screen = view.screens[index];
    const Vec3 across = screen.lower_right_m - screen.lower_left_m;
    const Vec3 up = screen.upper_left_m - screen.lower_left_m;
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; j <= steps; ++j) {
        const Vec3 direction =
            screen.lower_left_m + across * (double(i) / steps) + up * (double(j) / steps) - view.eye_point_m;
        const double azimuth = unwrapped(azimuth_rad(direction), centre_rad);
        left = std::max(left, azimuth);
        right = std::min(right, azimuth);
        top = std::max(top, elevation_rad(direction));
        bottom = std::min(bottom, elevation_rad(direction));
      }
  }
  const auto centre = [&](std::size_t i) {
    return unwrapped(azimuth_rad(middle(view.screens[i]) - view.eye_point_m), centre_rad);
  };
  std::sort(screens.begin(), screens.end(), [&](std::size_t a, std::size_t b) { return centre(a) > centre(b); });
  PanoramaRow row;
  row.screens = std::move(screens);
  row.left_azimuth_rad = left;
  row.top_elevation_rad = top;
  row.width_px = std::ceil((left - right) * pixels_per_rad);
  row.height_px = std::ceil((top - bottom) * pixels_per_rad);
  return row;
}

}  // namespace

std::optional<Point> screen_point(const PanoramaScreen& screen, const Vec3& eye_point_m, const Vec3& direction) {
  const Vec3 across = screen.lower_right_m - screen.lower_left_m;
  const Vec3 up = screen.upper_left_m - screen.lower_left_m;
  const Vec3 normal = glm::cross(across, up);
  const double approach = glm::dot(normal, direction);
  // The front of a screen faces the eye, so a ray that meets it runs against its normal.
  if (approach >= 0.0) return std::nullopt;
  const double distance = glm::dot(normal, screen.lower_left_m - eye_point_m) / approach;
  if (!(distance > 0.0)) return std::nullopt;
  const Vec3 offset = eye_point_m + direction * distance - screen.lower_left_m;
  const Point point{glm::dot(offset, across) / glm::dot(across, across), 1.0 - glm::dot(offset, up) / glm::dot(up, up)};
  if (point.x < 0.0 || point.x > 1.0 || point.y < 0.0 || point.y > 1.0) return std::nullopt;
  return point;
}

PanoramaLayout layout_panorama(const PanoramaView& view) {
  PanoramaLayout layout;
  layout.pixels_per_rad = view.pixels_per_degree / radians_per_degree;
  std::vector<std::size_t> ahead, behind;
  for (std::size_t i = 0; i < view.screens.size(); ++i) {
    const double azimuth = azimuth_rad(middle(view.screens[i]) - view.eye_point_m);
    (std::abs(azimuth) <= ahead_limit_rad ? ahead : behind).push_back(i);
  }
  if (!ahead.empty()) layout.rows.push_back(measure_row(view, std::move(ahead), 0.0, layout.pixels_per_rad));
  if (!behind.empty())
    layout.rows.push_back(measure_row(view, std::move(behind), std::numbers::pi, layout.pixels_per_rad));
  double widest = 640.0, top = label_above_px + 12.0;
  for (const PanoramaRow& row : layout.rows) widest = std::max(widest, row.width_px);
  layout.width_px = static_cast<std::uint32_t>(widest + 2 * margin_px);
  for (PanoramaRow& row : layout.rows) {
    row.left_px = std::floor((layout.width_px - row.width_px) / 2.0);
    row.top_px = top;
    top += row.height_px + label_below_px + label_above_px;
  }
  // With one row only, title and plan need a strip of their own.
  if (layout.rows.size() < 2) top += 200.0;
  layout.height_px = static_cast<std::uint32_t>(top - label_above_px + 10.0);
  return layout;
}

Point panorama_pixel(const PanoramaLayout& layout, const PanoramaRow& row, const Vec3& direction) {
  const double half_width_rad = row.width_px / layout.pixels_per_rad / 2.0;
  const double azimuth = unwrapped(azimuth_rad(direction), row.left_azimuth_rad - half_width_rad);
  return {row.left_px + (row.left_azimuth_rad - azimuth) * layout.pixels_per_rad,
          row.top_px + (row.top_elevation_rad - elevation_rad(direction)) * layout.pixels_per_rad};
}

}  // namespace septet::image
