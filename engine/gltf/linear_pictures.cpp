#include "engine/gltf/linear_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace septet::gltf {
namespace {

using image::Image;

std::uint8_t code_of(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

}  // namespace

Image properties_of(const Image* rough, const Image* dark, float strength) {
  const Image& larger = !rough || (dark && dark->width > rough->width) ? *dark : *rough;
  Image packed(larger.width, larger.height, {255, 255, 255, 255});
  const auto at = [&](const Image& picture, std::uint32_t x, std::uint32_t y) {
    const auto nearest = [](std::uint32_t n, std::uint32_t size, std::uint32_t of) {
      return static_cast<std::uint32_t>(std::uint64_t{n} * size / of);
    };
    return picture.at(nearest(x, picture.width, packed.width), nearest(y, picture.height, packed.height));
  };
  for (std::uint32_t y = 0; y < packed.height; ++y)
    for (std::uint32_t x = 0; x < packed.width; ++x) {
      image::Color color{255, 255, 255, 255};
      if (dark) color.red = code_of(1.0f + strength * (static_cast<float>(at(*dark, x, y).red) / 255.0f - 1.0f));
      if (rough) {
        const image::Color read = at(*rough, x, y);
        color.green = read.green;
        color.blue = read.blue;
      }
      packed.set(x, y, color);
    }
  return packed;
}

void scale_normals(Image& normals, float scale) {
  for (std::size_t i = 0; i + 3 < normals.rgba.size(); i += 4) {
    glm::vec3 n;
    for (int k = 0; k < 3; ++k)
      n[k] = static_cast<float>(normals.rgba[i + static_cast<std::size_t>(k)]) / 127.5f - 1.0f;
    n.x *= scale;
    n.y *= scale;
    const float length = glm::length(n);
    if (!(length > 0.0f)) continue;
    for (int k = 0; k < 3; ++k) normals.rgba[i + static_cast<std::size_t>(k)] = code_of(0.5f + 0.5f * n[k] / length);
  }
}

}  // namespace septet::gltf
