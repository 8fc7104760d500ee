#include "engine/scenery/world/facades.hpp"

#include <algorithm>

#include "engine/core/random.hpp"
#include "engine/geometry/noise.hpp"
#include "engine/image/draw.hpp"
#include "engine/scenery/lettering.hpp"

namespace septet::scenery {
namespace {

using geometry::lattice_random;
using image::Color;
using image::Image;

constexpr std::uint32_t facade_px = 128;
constexpr Color frame{246, 246, 242}, pane{52, 60, 72}, curtain{150, 152, 150}, sill{228, 226, 220},
    shade{150, 146, 140};

Color grey_pixel(double value) {
  const auto byte = static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0));
  return {byte, byte, byte};
}

template <class Value>
Image wall(Value value) {
  Image image(facade_px, facade_px);
  for (std::uint32_t y = 0; y < facade_px; ++y)
    for (std::uint32_t x = 0; x < facade_px; ++x) image.set(x, y, grey_pixel(value(x, y)));
  return image;
}

void add_window(Image& image) {
  image::fill(image, 37, 30, 54, 4, sill);
  image::fill(image, 40, 34, 48, 56, frame);
  image::fill(image, 45, 39, 38, 46, pane);
  image::fill(image, 45, 39, 7, 46, curtain);
  image::fill(image, 76, 39, 7, 46, curtain);
  image::fill(image, 62, 39, 4, 46, frame);
  image::fill(image, 45, 53, 38, 3, frame);
  image::fill(image, 35, 90, 58, 4, sill);
  image::fill(image, 37, 94, 54, 3, shade);
}

}  // namespace

Image plaster_facade_texture(std::uint64_t seed) {
  Image image = wall([&](std::uint32_t x, std::uint32_t y) {
    // A band between the storeys.
    const double band = y < 3 ? 20.0 : y < 5 ? -40.0 : 0.0;
    return 216.0 + band + 9.0 * (lattice_random(x, y, seed) - 0.5) +
           8.0 * (lattice_random(x / 16, y / 16, seed + 1) - 0.5);
  });
  add_window(image);
  return image;
}

Image brick_facade_texture(std::uint64_t seed) {
  Image image = wall([&](std::uint32_t x, std::uint32_t y) {
    constexpr std::uint32_t course_px = 4, brick_px = 8;
    const std::uint32_t course = y / course_px, shifted = x + (course % 2) * brick_px / 2;
    const bool joint = y % course_px == 0 || shifted % brick_px == 0;
    return joint ? 190.0
                 : 206.0 + 60.0 * (lattice_random(shifted / brick_px % (facade_px / brick_px), course, seed) - 0.5);
  });
  add_window(image);
  return image;
}

Image shop_front_texture(std::string_view name, Color sign) {
  Image image(2 * facade_px, facade_px);
  image::fill(image, 0, 0, image.width, image.height, {188, 184, 176});
  image::fill(image, 4, 6, 248, 26, sign);
  const Lettering bold(image::FontStyle::bold);
  bold.centred(image, 128, 27, name, 22, {248, 246, 238});
  const Color glass{44, 52, 60}, dark{30, 30, 32};
  image::fill(image, 10, 38, 168, 74, dark);
  image::fill(image, 14, 42, 78, 66, glass);
  image::fill(image, 96, 42, 78, 66, glass);
  // Goods behind the panes.
  Random random(name.size(), sign.red);
  for (int i = 0; i < 22; ++i) {
    const auto x = 16 + static_cast<std::int64_t>(random.below(150)),
               height = 5 + static_cast<std::int64_t>(random.below(14));
    const auto tone = [&] { return static_cast<std::uint8_t>(70 + random.below(150)); };
    if (x > 84 && x < 98) continue;
    const Color goods{tone(), tone(), tone()};
    image::fill(image, x, 106 - height, 6, height, goods);
  }
  image::fill(image, 190, 38, 50, 90, dark);
  image::fill(image, 196, 44, 38, 70, glass);
  image::fill(image, 228, 80, 3, 12, {200, 200, 196});
  image::fill(image, 0, 116, 188, 12, {112, 108, 104});
  return image;
}

}  // namespace septet::scenery
