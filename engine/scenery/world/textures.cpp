#include "engine/scenery/world/textures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/core/random.hpp"
#include "engine/geometry/noise.hpp"
#include "engine/image/draw.hpp"

namespace septet::scenery {
namespace {

using geometry::fractal_noise;
using geometry::gradient_noise;
using geometry::lattice_random;
using image::Color;
using image::Image;

std::uint8_t byte_of(double value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0)); }

Color grey(double value, double warmth = 0.0) {
  return {byte_of(value + warmth), byte_of(value), byte_of(value - warmth)};
}

/// Gaussian around `middle`.
double bell(double x, double middle, double width) {
  const double d = (x - middle) / width;
  return std::exp(-d * d);
}

/// Paints a square texture, pixel by pixel: `paint` gets the pixel and the place of its middle in [0, 1].
template <class Paint>
Image painted(std::uint32_t size, Paint paint) {
  Image image(size, size);
  for (std::uint32_t y = 0; y < size; ++y)
    for (std::uint32_t x = 0; x < size; ++x) image.set(x, y, paint(x, y, (x + 0.5) / size, (y + 0.5) / size));
  return image;
}

/// Positions at which an object at `x` is drawn so that the texture tiles: also beyond the edges that it is within
/// `reach` of.
std::vector<double> copies(double x, double size, double reach) {
  std::vector<double> result;
  for (const double shifted : {x - size, x, x + size})
    if (shifted >= -reach && shifted <= size + reach) result.push_back(shifted);
  return result;
}

}  // namespace

Image asphalt_texture(std::uint64_t seed) {
  return painted(512, [&](std::uint32_t x, std::uint32_t y, double u, double v) -> Color {
    // Stones of two sizes: single light and dark grains over a fine mottle.
    const double grain = lattice_random(x, y, seed) - 0.5;
    const double stone = lattice_random(x / 2, y / 2, seed + 1);
    const double mottle = fractal_noise(u * 24, v * 24, 3, seed + 2, 24);
    const double patches = fractal_noise(u * 4, v * 4, 3, seed + 3, 4);
    double value = 92.0 + 26.0 * grain + 7.0 * mottle + 5.0 * patches;
    if (stone > 0.93) value += 26.0;
    if (stone < 0.05) value -= 20.0;
    // Wheels polish two tracks; oil darkens the middle; the paver's seam runs along both edges.
    const double tracks = bell(u, 0.27, 0.09) + bell(u, 0.73, 0.09);
    value += 9.0 * tracks - 7.0 * bell(u, 0.5, 0.10) * (0.7 + 0.5 * patches);
    const double edge = std::min(u, 1.0 - u);
    value -= 16.0 * bell(edge, 0.0, 0.006 + 0.003 * gradient_noise(v * 32, 0.5, seed + 4, 32));
    return grey(value, 1.0);
  });
}

Image plain_asphalt_texture(std::uint64_t seed) {
  return painted(256, [&](std::uint32_t x, std::uint32_t y, double u, double v) -> Color {
    const double grain = lattice_random(x, y, seed) - 0.5, stone = lattice_random(x / 2, y / 2, seed + 1);
    double value = 94.0 + 24.0 * grain + 7.0 * fractal_noise(u * 16, v * 16, 3, seed + 2, 16) +
                   6.0 * fractal_noise(u * 4, v * 4, 3, seed + 3, 4);
    if (stone > 0.93) value += 24.0;
    if (stone < 0.05) value -= 18.0;
    return grey(value, 1.0);
  });
}

Image paving_texture(std::uint64_t seed) {
  constexpr std::uint32_t slabs = 3;  // Slabs of half a metre.
  return painted(192, [&](std::uint32_t x, std::uint32_t y, double u, double v) -> Color {
    const auto row = static_cast<std::uint32_t>(v * slabs);
    // Each row is laid half a slab further.
    const double across = u * slabs + (row % 2 == 0 ? 0.0 : 0.5), along = v * slabs;
    const auto slab = static_cast<std::uint32_t>(across) % slabs;
    const double joint = std::min(
        {across - std::floor(across), std::ceil(across) - across, along - std::floor(along), std::ceil(along) - along});
    double value = 190.0 + 16.0 * (lattice_random(slab, row, seed) - 0.5) +
                   14.0 * (lattice_random(x, y, seed + 1) - 0.5) + 10.0 * fractal_noise(u * 8, v * 8, 3, seed + 2, 8);
    if (joint < 0.025) value -= 58.0;
    return grey(value, 2.0);
  });
}

Image ground_texture(std::uint64_t seed) {
  return painted(256, [&](std::uint32_t x, std::uint32_t y, double u, double v) -> Color {
    const double clumps = fractal_noise(u * 8, v * 8, 4, seed, 8);
    const double blades = lattice_random(x, y / 2, seed + 1) - 0.5;
    const double value = 196.0 + 34.0 * clumps + 46.0 * blades;
    const double dry = 10.0 * fractal_noise(u * 4, v * 4, 2, seed + 2, 4);
    return {byte_of(value + dry), byte_of(value), byte_of(value - 10.0 - dry)};
  });
}

Image concrete_texture(std::uint64_t seed) {
  return painted(256, [&](std::uint32_t x, std::uint32_t y, double u, double v) -> Color {
    double value =
        198.0 + 14.0 * fractal_noise(u * 8, v * 8, 4, seed, 8) + 10.0 * (lattice_random(x, y, seed + 1) - 0.5);
    // Rain streaks run down; panels meet at the texture's edge.
    value -= 16.0 * std::max(0.0, fractal_noise(u * 32, v * 2, 2, seed + 2, 2)) * (0.4 + 0.6 * v);
    if (x < 2 || y < 2) value -= 42.0;
    if (lattice_random(x, y, seed + 3) > 0.998) value -= 32.0;  // Pores of 16 mm.
    return grey(value, 2.0);
  });
}

Image leaf_texture(std::uint64_t seed) {
  constexpr std::uint32_t size = 256;
  Image image(size, size, {70, 92, 40, 0});
  Random random(seed);
  // Dabs in layers; early ones are dark and deep, late ones bright and outside.
  constexpr int dabs = 900;
  for (int i = 0; i < dabs; ++i) {
    const double x = random.uniform(0, size), y = random.uniform(0, size), turn = random.uniform(0, std::numbers::pi);
    const double depth = static_cast<double>(i) / dabs, length = random.uniform(5, 9);
    const double light = 0.50 + 0.50 * depth + random.uniform(-0.10, 0.10);
    const Color color{byte_of(118 * light), byte_of(148 * light), byte_of(62 * light)};
    for (const double px : copies(x, size, 12.0))
      for (const double py : copies(y, size, 12.0))
        image::line(image, px, py, px + length * std::cos(turn), py + length * std::sin(turn), 4.6, color);
  }
  return image;
}

Image needle_texture(std::uint64_t seed) {
  constexpr std::uint32_t size = 256;
  Image image(size, size, {38, 56, 34, 0});
  Random random(seed);
  for (int i = 0; i < 340; ++i) {
    const double x = random.uniform(-10, size + 10), top = random.uniform(-20, 150);
    const double length = random.uniform(60, 110), lean = random.uniform(-18, 18);
    const double light = random.uniform(0.55, 1.1);
    const Color color{byte_of(62 * light), byte_of(88 * light), byte_of(54 * light)};
    image::line(image, x, top, x + lean, top + length, 5.0, color);
    for (int k = 1; k < 6; ++k) {
      const double at = top + length * k / 6, side = 9.0 * (1.0 - k / 8.0);
      image::line(image, x + lean * k / 6, at - 6, x + lean * k / 6 - side, at + 5, 2.4, color);
      image::line(image, x + lean * k / 6, at - 6, x + lean * k / 6 + side, at + 5, 2.4, color);
    }
  }
  return image;
}

namespace {

struct Crown {
  double middle_x, middle_y, radius_x, radius_y;  ///< Pixels; the picture is 128 × 256.
  Color color;
};

void paint_crown(Image& image, const Crown& crown, Random& random, int dabs, bool pointed) {
  for (int i = 0; i < dabs; ++i) {
    const double depth = static_cast<double>(i) / dabs;
    const double angle = random.uniform(0, 2 * std::numbers::pi),
                 reach = std::sqrt(random.uniform()) * (0.80 + 0.20 * std::sin(angle * 5 + depth * 3));
    double dx = reach * std::cos(angle), dy = reach * std::sin(angle);
    if (pointed) {
      // Cone, evenly filled: as wide as it is far from the tip.
      dy = 2.0 * std::sqrt(random.uniform()) - 1.0;
      dx = random.uniform(-0.5, 0.5) * (1.0 + dy) * (0.88 + 0.12 * std::sin(dy * 22.0));
    }
    const double x = crown.middle_x + dx * crown.radius_x, y = crown.middle_y + dy * crown.radius_y;
    // Bright at the top and on one side, dark inside and below.
    const double light = (0.50 + 0.34 * depth - 0.20 * dy - 0.08 * dx) * random.uniform(0.85, 1.15);
    const Color color{byte_of(crown.color.red * light), byte_of(crown.color.green * light),
                      byte_of(crown.color.blue * light)};
    const double turn = random.uniform(0, std::numbers::pi), length = pointed ? 7.0 : 5.0;
    image::line(image, x, y, x + length * std::cos(turn), y + length * std::sin(turn) * (pointed ? 0.5 : 1.0), 4.4,
                color);
  }
}

}  // namespace

Image tree_picture_texture(std::uint64_t seed) {
  Image image(128 * tree_pictures, 256, {70, 84, 44, 0});
  Random random(seed);
  const Color brown{72, 58, 44}, birch_bark{196, 192, 182};
  image::polygon(image, {{58, 254}, {70, 254}, {67, 150}, {61, 150}}, brown);
  paint_crown(image, {64, 112, 52, 92, {146, 164, 82}}, random, 1500, false);
  image::polygon(image, {{189, 254}, {196, 254}, {194, 90}, {190, 90}}, birch_bark);
  paint_crown(image, {192, 108, 36, 98, {170, 186, 100}}, random, 900, false);
  image::polygon(image, {{316, 254}, {324, 254}, {321, 190}, {319, 190}}, brown);
  paint_crown(image, {320, 124, 50, 118, {84, 112, 74}}, random, 1700, true);
  paint_crown(image, {448, 168, 56, 84, {138, 158, 82}}, random, 1500, false);
  // Painted large, sent small: these trees are never seen near.
  return image::resize(image, image.width / 2, image.height / 2);
}

Image wood_edge_texture(std::uint64_t seed) {
  constexpr std::uint32_t width = 512, height = 128;
  Image image(width, height, {50, 66, 36, 0});
  Random random(seed);
  image::fill(image, 0, 64, width, 64, {34, 44, 26});
  for (int i = 0; i < 46; ++i) {
    const bool spruce = random.uniform() < 0.45;
    const double x = random.uniform(0, width), top = random.uniform(4, 46);
    const double light = random.uniform(0.75, 1.1);
    const Color color = spruce ? Color{byte_of(74 * light), byte_of(98 * light), byte_of(62 * light)}
                               : Color{byte_of(124 * light), byte_of(144 * light), byte_of(72 * light)};
    for (const double px : copies(x, width, 40.0)) {
      Random own(seed + static_cast<std::uint64_t>(i));
      paint_crown(image, {px, (top + 118) / 2, spruce ? 13.0 : 22.0, (118 - top) / 2, color}, own, 190, spruce);
    }
  }
  return image;
}

Image facade_texture(std::uint64_t seed) {
  Image image = painted(128, [&](std::uint32_t x, std::uint32_t y, double, double) -> Color {
    // Upright boards.
    const double board = x % 8 == 0 ? -34.0 : 0.0;
    return grey(214.0 + board + 12.0 * (lattice_random(x / 8, y / 24, seed) - 0.5));
  });
  image::fill(image, 40, 34, 48, 56, {246, 246, 242});
  image::fill(image, 45, 39, 38, 46, {58, 66, 78});
  image::fill(image, 62, 39, 4, 46, {246, 246, 242});
  image::fill(image, 45, 60, 38, 3, {246, 246, 242});
  return image;
}

}  // namespace septet::scenery
