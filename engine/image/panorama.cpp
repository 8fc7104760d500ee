#include "engine/image/panorama.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/image/font.hpp"
#include "engine/math/angle_units.hpp"

namespace septet::image {
namespace {

constexpr Color background{18, 21, 26}, dark{33, 38, 46}, faint{96, 106, 120}, plain{176, 184, 196},
    bright{240, 243, 247}, accent{255, 196, 84};

struct Fonts {
  Font regular, bold;
};

Vec3 direction_of(double azimuth_rad, double elevation_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad), std::cos(elevation_rad) * std::sin(azimuth_rad),
          std::sin(elevation_rad)};
}

/// Bilinear; `point` in [0, 1]².
Color sample(const Image& image, Point point) {
  const double x = std::clamp(point.x * image.width - 0.5, 0.0, image.width - 1.0);
  const double y = std::clamp(point.y * image.height - 0.5, 0.0, image.height - 1.0);
  const auto x0 = static_cast<std::uint32_t>(x), y0 = static_cast<std::uint32_t>(y);
  const std::uint32_t x1 = std::min(x0 + 1, image.width - 1), y1 = std::min(y0 + 1, image.height - 1);
  const auto fx = static_cast<float>(x - x0), fy = static_cast<float>(y - y0);
  const auto opaque = [&](std::uint32_t px, std::uint32_t py) {
    Color color = image.at(px, py);
    color.alpha = 255;
    return color;
  };
  return blend(blend(opaque(x0, y0), opaque(x1, y0), fx), blend(opaque(x0, y1), opaque(x1, y1), fx), fy);
}

/// The screens' pictures, four rays a pixel.
void draw_pictures(Image& target, const PanoramaView& view, const PanoramaLayout& layout, const PanoramaRow& row) {
  for (int y = 0; y < static_cast<int>(row.height_px); ++y)
    for (int x = 0; x < static_cast<int>(row.width_px); ++x) {
      int sum[3] = {}, hits = 0;
      for (int s = 0; s < 4; ++s) {
        const int right = s % 2, down = s / 2;
        const double azimuth = row.left_azimuth_rad - (x + 0.25 + 0.5 * right) / layout.pixels_per_rad;
        const double elevation = row.top_elevation_rad - (y + 0.25 + 0.5 * down) / layout.pixels_per_rad;
        const Vec3 direction = direction_of(azimuth, elevation);
        for (const std::size_t index : row.screens) {
          const PanoramaScreen& screen = view.screens[index];
          const auto point = screen_point(screen, view.eye_point_m, direction);
          if (!point) continue;
          const Color color = screen.image && screen.image->width > 0 ? sample(*screen.image, *point) : dark;
          sum[0] += color.red;
          sum[1] += color.green;
          sum[2] += color.blue;
          ++hits;
          break;
        }
      }
      if (hits == 0) continue;
      const auto mean = [&](int channel) { return static_cast<std::uint8_t>((sum[channel] + hits / 2) / hits); };
      const auto px = static_cast<std::uint32_t>(row.left_px) + static_cast<std::uint32_t>(x);
      const auto py = static_cast<std::uint32_t>(row.top_px) + static_cast<std::uint32_t>(y);
      target.set(px, py, blend(background, {mean(0), mean(1), mean(2)}, static_cast<float>(hits) / 4.0f));
    }
}

/// Names above, azimuth below, elevation at the left.
void draw_labels(Image& target, const PanoramaView& view, const PanoramaLayout& layout, const PanoramaRow& row,
                 const Fonts& fonts) {
  for (const std::size_t index : row.screens) {
    const PanoramaScreen& screen = view.screens[index];
    const Vec3 up = screen.upper_left_m - screen.lower_left_m;
    const auto x_of = [&](const Vec3& corner) {
      return panorama_pixel(layout, row, corner + up * 0.5 - view.eye_point_m).x;
    };
    const double left = x_of(screen.lower_left_m), right = x_of(screen.lower_right_m);
    const double bar = row.top_px - 7.0;
    line(target, left + 3, bar, right - 3, bar, 2.0, faint);
    fonts.bold.draw_centred(target, (left + right) / 2, bar - 8.0, screen.name, 15.0, bright);
  }
  const double bottom = row.top_px + row.height_px;
  const double right_azimuth = row.left_azimuth_rad - row.width_px / layout.pixels_per_rad;
  const auto first = static_cast<int>(std::ceil(right_azimuth / radians_per_degree / 10.0 - 1e-9)) * 10;
  for (int degrees = first; degrees * radians_per_degree <= row.left_azimuth_rad + 1e-9; degrees += 10) {
    const double x = row.left_px + (row.left_azimuth_rad - degrees * radians_per_degree) * layout.pixels_per_rad;
    const bool labelled = degrees % 20 == 0;
    line(target, x, bottom + 3, x, bottom + (labelled ? 10 : 6), 1.5, labelled ? plain : faint);
    const int turned = degrees > 180 ? 360 - degrees : degrees;
    const char* side = degrees == 0 || degrees == 180 ? "" : degrees > 0 && degrees < 180 ? " left" : " right";
    if (labelled)
      fonts.regular.draw_centred(target, x, bottom + 25, fmt::format("{}°{}", std::abs(turned), side), 13.0, plain);
  }
  for (int degrees = -10; degrees <= 10; degrees += 10) {
    const double y = row.top_px + (row.top_elevation_rad - degrees * radians_per_degree) * layout.pixels_per_rad;
    if (y < row.top_px || y > bottom) continue;
    const std::string text = fmt::format("{:+d}°", degrees);
    fonts.regular.draw(target, row.left_px - 8 - fonts.regular.width_px(text, 12.0), y + 4,
                       degrees == 0 ? "  0°" : text, 12.0, faint);
  }
}

void draw_title(Image& target, const PanoramaView& view, double left, double top, const Fonts& fonts) {
  fonts.bold.draw(target, left, top + 26, view.title, 26.0, bright);
  double y = top + 56;
  for (const std::string& detail : view.details) {
    fonts.regular.draw(target, left, y, detail, 16.0, plain);
    y += 24;
  }
}

/// The screens seen from above around the eye, ahead at the top.
void draw_plan(Image& target, const PanoramaView& view, double left, double top, double side_px, const Fonts& fonts) {
  double reach_m = 0.1;
  for (const PanoramaScreen& screen : view.screens)
    for (const Vec3& corner : {screen.lower_left_m, screen.lower_right_m}) {
      const Vec3 offset = corner - view.eye_point_m;
      reach_m = std::max(reach_m, std::hypot(offset.x, offset.y));
    }
  const double scale = side_px * 0.42 / reach_m;
  const double centre_x = left + side_px / 2, centre_y = top + side_px / 2;
  const auto x_of = [&](const Vec3& p) { return centre_x - (p.y - view.eye_point_m.y) * scale; };
  const auto y_of = [&](const Vec3& p) { return centre_y - (p.x - view.eye_point_m.x) * scale; };
  for (const PanoramaScreen& screen : view.screens) {
    line(target, centre_x, centre_y, x_of(screen.lower_left_m), y_of(screen.lower_left_m), 1.0, dark);
    line(target, centre_x, centre_y, x_of(screen.lower_right_m), y_of(screen.lower_right_m), 1.0, dark);
  }
  for (const PanoramaScreen& screen : view.screens)
    line(target, x_of(screen.lower_left_m), y_of(screen.lower_left_m), x_of(screen.lower_right_m),
         y_of(screen.lower_right_m), 3.0, plain);
  polygon(
      target,
      {{centre_x, centre_y - 9}, {centre_x + 6, centre_y + 7}, {centre_x, centre_y + 4}, {centre_x - 6, centre_y + 7}},
      accent);
  const std::string size = fmt::format("eye to corner {:.2f} m", reach_m);
  fonts.regular.draw_centred(target, centre_x, top + side_px - 2, size, 12.0, faint);
}

}  // namespace

Expected<Image> unroll(const PanoramaView& view) {
  auto regular = Font::find(FontStyle::regular);
  if (!regular) return tl::unexpected(regular.error());
  auto bold = Font::find(FontStyle::bold);
  if (!bold) return tl::unexpected(bold.error());
  const Fonts fonts{std::move(*regular), std::move(*bold)};

  const PanoramaLayout layout = layout_panorama(view);
  Image picture(layout.width_px, layout.height_px, background);
  for (const PanoramaRow& row : layout.rows) {
    draw_pictures(picture, view, layout, row);
    draw_labels(picture, view, layout, row, fonts);
  }
  const double top = layout.rows.size() > 1   ? layout.rows[1].top_px
                     : layout.rows.size() > 0 ? layout.rows[0].top_px + layout.rows[0].height_px + 50.0
                                              : 20.0;
  const double room_px = layout.height_px - top - 12.0;
  draw_title(picture, view, 56.0, top, fonts);
  draw_plan(picture, view, layout.width_px - room_px - 56.0, top - 10.0, room_px, fonts);
  return picture;
}

}  // namespace septet::image
