#pragma once
/// A picture in memory: 8-bit sRGB with straight (not premultiplied) alpha, rows from the top.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/core/check.hpp"

namespace septet::image {

/// One pixel, sRGB encoded.
struct Color {
  std::uint8_t red = 0, green = 0, blue = 0, alpha = 255;
  bool operator==(const Color&) const = default;
};

struct Image {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  ///< 4 · width · height bytes.

  Image() = default;
  Image(std::uint32_t width_px, std::uint32_t height_px, Color color = {})
      : width(width_px), height(height_px), rgba(std::size_t{4} * width_px * height_px) {
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
      rgba[i] = color.red;
      rgba[i + 1] = color.green;
      rgba[i + 2] = color.blue;
      rgba[i + 3] = color.alpha;
    }
  }

  bool contains(std::int64_t x, std::int64_t y) const { return x >= 0 && y >= 0 && x < width && y < height; }
  Color at(std::uint32_t x, std::uint32_t y) const {
    const std::uint8_t* p = &rgba[offset(x, y)];
    return {p[0], p[1], p[2], p[3]};
  }
  void set(std::uint32_t x, std::uint32_t y, Color color) {
    std::uint8_t* p = &rgba[offset(x, y)];
    p[0] = color.red;
    p[1] = color.green;
    p[2] = color.blue;
    p[3] = color.alpha;
  }
  bool operator==(const Image&) const = default;

 private:
  std::size_t offset(std::uint32_t x, std::uint32_t y) const {
    SEPTET_CHECK(x < width && y < height, "pixel ({}, {}) of {} × {}", x, y, width, height);
    return (std::size_t{y} * width + x) * 4;
  }
};

}  // namespace septet::image
