#include "engine/image/draw.hpp"

#include <algorithm>
#include <cmath>

namespace septet::image {
namespace {

std::uint8_t to_byte(float value) { return static_cast<std::uint8_t>(std::clamp(value + 0.5f, 0.0f, 255.0f)); }

void blend_pixel(Image& image, std::int64_t x, std::int64_t y, Color color, double coverage) {
  if (coverage <= 0.0 || !image.contains(x, y)) return;
  const auto px = static_cast<std::uint32_t>(x), py = static_cast<std::uint32_t>(y);
  image.set(px, py, blend(image.at(px, py), color, static_cast<float>(std::min(coverage, 1.0))));
}

int winding_number(const std::vector<Point>& corners, double x, double y) {
  int winding = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point a = corners[i], b = corners[(i + 1) % corners.size()];
    const double side = (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
    if (a.y <= y && b.y > y && side > 0.0) ++winding;
    if (a.y > y && b.y <= y && side < 0.0) --winding;
  }
  return winding;
}

/// The source pixels that one target pixel covers, with the share of each, along one axis.
struct Coverage {
  std::uint32_t first = 0;
  std::vector<double> shares;
};

std::vector<Coverage> coverages(std::uint32_t source, std::uint32_t target) {
  std::vector<Coverage> result(target);
  const double scale = static_cast<double>(source) / target;
  for (std::uint32_t i = 0; i < target; ++i) {
    const double begin = i * scale, end = (i + 1) * scale;
    result[i].first = std::min(static_cast<std::uint32_t>(begin), source - 1);
    for (std::uint32_t s = result[i].first; s < source && s < end; ++s) {
      const double share = std::min<double>(s + 1, end) - std::max<double>(s, begin);
      result[i].shares.push_back(share / scale);
    }
  }
  return result;
}

}  // namespace

Color blend(Color under, Color over, float coverage) {
  const float over_alpha = coverage * over.alpha / 255.0f;
  const float under_alpha = under.alpha / 255.0f * (1.0f - over_alpha);
  const float alpha = over_alpha + under_alpha;
  if (alpha <= 0.0f) return under;
  const auto mix = [&](std::uint8_t below, std::uint8_t above) {
    return to_byte((above * over_alpha + below * under_alpha) / alpha);
  };
  return {mix(under.red, over.red), mix(under.green, over.green), mix(under.blue, over.blue), to_byte(alpha * 255.0f)};
}

void fill(Image& image, std::int64_t x, std::int64_t y, std::int64_t width, std::int64_t height, Color color) {
  const std::int64_t right = std::min<std::int64_t>(x + width, image.width);
  const std::int64_t bottom = std::min<std::int64_t>(y + height, image.height);
  for (std::int64_t row = std::max<std::int64_t>(y, 0); row < bottom; ++row)
    for (std::int64_t column = std::max<std::int64_t>(x, 0); column < right; ++column)
      blend_pixel(image, column, row, color, 1.0);
}

void line(Image& image, double x0, double y0, double x1, double y1, double width_px, Color color) {
  const double reach = width_px / 2.0 + 1.0;
  const double dx = x1 - x0, dy = y1 - y0;
  const double length_squared = dx * dx + dy * dy;
  const auto left = static_cast<std::int64_t>(std::floor(std::min(x0, x1) - reach));
  const auto right = static_cast<std::int64_t>(std::ceil(std::max(x0, x1) + reach));
  const auto top = static_cast<std::int64_t>(std::floor(std::min(y0, y1) - reach));
  const auto bottom = static_cast<std::int64_t>(std::ceil(std::max(y0, y1) + reach));
  for (std::int64_t y = std::max<std::int64_t>(top, 0);
       y <= std::min<std::int64_t>(bottom, std::int64_t{image.height} - 1); ++y)
    for (std::int64_t x = std::max<std::int64_t>(left, 0);
         x <= std::min<std::int64_t>(right, std::int64_t{image.width} - 1); ++x) {
      const double px = x + 0.5 - x0, py = y + 0.5 - y0;
      double along = 0.0;
      if (length_squared > 0.0) along = std::clamp((px * dx + py * dy) / length_squared, 0.0, 1.0);
      const double distance = std::hypot(px - along * dx, py - along * dy);
      blend_pixel(image, x, y, color, width_px / 2.0 + 0.5 - distance);
    }
}

void polygon(Image& image, const std::vector<Point>& corners, Color color) {
  if (corners.size() < 3) return;
  const auto by_x = [](Point a, Point b) { return a.x < b.x; };
  const auto by_y = [](Point a, Point b) { return a.y < b.y; };
  const auto [left, right] = std::minmax_element(corners.begin(), corners.end(), by_x);
  const auto [top, bottom] = std::minmax_element(corners.begin(), corners.end(), by_y);
  const auto x_end = std::min<std::int64_t>(std::llround(std::ceil(right->x)), image.width);
  const auto y_end = std::min<std::int64_t>(std::llround(std::ceil(bottom->y)), image.height);
  for (auto y = std::max<std::int64_t>(std::llround(std::floor(top->y)), 0); y < y_end; ++y)
    for (auto x = std::max<std::int64_t>(std::llround(std::floor(left->x)), 0); x < x_end; ++x) {
      int inside = 0;
      for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
          if (winding_number(corners, x + (column + 0.5) / 4, y + (row + 0.5) / 4) != 0) ++inside;
      blend_pixel(image, x, y, color, inside / 16.0);
    }
}

void rounded_rectangle(Image& image, double x, double y, double width, double height, double radius_px, Color color) {
  const double middle_x = x + width / 2, middle_y = y + height / 2;
  const auto x_end = std::min<std::int64_t>(std::llround(std::ceil(x + width)), image.width);
  const auto y_end = std::min<std::int64_t>(std::llround(std::ceil(y + height)), image.height);
  for (auto py = std::max<std::int64_t>(std::llround(std::floor(y)), 0); py < y_end; ++py)
    for (auto px = std::max<std::int64_t>(std::llround(std::floor(x)), 0); px < x_end; ++px) {
      const double dx = std::abs(px + 0.5 - middle_x) - (width / 2 - radius_px);
      const double dy = std::abs(py + 0.5 - middle_y) - (height / 2 - radius_px);
      const double outside = std::hypot(std::max(dx, 0.0), std::max(dy, 0.0));
      const double distance = outside + std::min(std::max(dx, dy), 0.0) - radius_px;
      blend_pixel(image, px, py, color, 0.5 - distance);
    }
}

Image resize(const Image& image, std::uint32_t width, std::uint32_t height) {
  SEPTET_CHECK(image.width > 0 && image.height > 0 && width > 0 && height > 0, "{} × {} to {} × {}", image.width,
               image.height, width, height);
  const auto columns = coverages(image.width, width);
  const auto rows = coverages(image.height, height);
  Image result(width, height);
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      double sum[4] = {};
      for (std::size_t j = 0; j < rows[y].shares.size(); ++j)
        for (std::size_t i = 0; i < columns[x].shares.size(); ++i) {
          const Color c =
              image.at(columns[x].first + static_cast<std::uint32_t>(i), rows[y].first + static_cast<std::uint32_t>(j));
          const double weight = columns[x].shares[i] * rows[y].shares[j] * c.alpha;
          sum[0] += weight * c.red;
          sum[1] += weight * c.green;
          sum[2] += weight * c.blue;
          sum[3] += weight;
        }
      const double scale = sum[3] > 0.0 ? 1.0 / sum[3] : 0.0;
      result.set(x, y,
                 {to_byte(static_cast<float>(sum[0] * scale)), to_byte(static_cast<float>(sum[1] * scale)),
                  to_byte(static_cast<float>(sum[2] * scale)), to_byte(static_cast<float>(sum[3]))});
    }
  return result;
}

}  // namespace septet::image
