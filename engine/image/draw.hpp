#pragma once
/// Small drawing on images. Coordinates are pixels, x to the right, y down; drawing is clipped to the image.

#include "engine/image/image.hpp"

namespace septet::image {

/// `over` blended onto `under` by its alpha times `coverage` (0…1); the result's alpha never falls.
Color blend(Color under, Color over, float coverage = 1.0f);

/// The rectangle [x, x + width) × [y, y + height), blended.
void fill(Image& image, std::int64_t x, std::int64_t y, std::int64_t width, std::int64_t height, Color color);

/// A straight stroke with round ends between two points, antialiased; pixel centres lie at halves.
void line(Image& image, double x0, double y0, double x1, double y1, double width_px, Color color);

/// A filled polygon (non-zero winding), antialiased with 4 × 4 samples a pixel.
struct Point {
  double x = 0.0, y = 0.0;
};
void polygon(Image& image, const std::vector<Point>& corners, Color color);

/// A filled rectangle with round corners, antialiased.
void rounded_rectangle(Image& image, double x, double y, double width, double height, double radius_px, Color color);

/// Box filter: every target pixel is the mean of the source area that it covers, weighted by alpha.
Image resize(const Image& image, std::uint32_t width, std::uint32_t height);

}  // namespace septet::image
