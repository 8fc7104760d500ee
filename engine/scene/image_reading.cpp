#include "engine/scene/image_reading.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <glm/common.hpp>

#include "engine/image/srgb.hpp"

namespace septet::scene {
namespace {

const std::array<float, 256>& light_of_codes() {
  static const std::array<float, 256> light = [] {
    std::array<float, 256> values{};
    for (std::size_t code = 0; code < values.size(); ++code)
      values[code] = image::light_of_srgb(static_cast<float>(code) / 255.0f);
    return values;
  }();
  return light;
}

/// From 0 to 1 for any number.
float in_unit(float at, bool clamps) {
  const float within = clamps ? std::clamp(at, 0.0f, 1.0f) : at - std::floor(at);
  return within >= 0.0f && within <= 1.0f ? within : 0.0f;
}

std::size_t pixel_index(std::int64_t at, std::uint32_t size, bool clamps) {
  const std::int64_t count{size};
  const std::int64_t pixel = clamps ? std::clamp<std::int64_t>(at, 0, count - 1) : (at + count) % count;
  return static_cast<std::size_t>(pixel);
}

}  // namespace

glm::vec4 read_image(const TextureImage& image, const glm::vec2& uv, bool filtered) {
  if (image.width == 0 || image.height == 0) return {0.0f, 0.0f, 0.0f, 1.0f};
  const ImageSampling& sampling = image.sampling;
  const glm::vec2 at = glm::vec2(in_unit(uv.x, sampling.clamps_u), in_unit(uv.y, sampling.clamps_v)) *
                           glm::vec2(image.width, image.height) -
                       0.5f;
  const bool nearest = sampling.sharp || !filtered;
  const glm::vec2 low = nearest ? glm::floor(at + 0.5f) : glm::floor(at), share = at - low;
  const auto x = static_cast<std::int64_t>(low.x), y = static_cast<std::int64_t>(low.y);
  const auto pixel = [&](std::int64_t column, std::int64_t row) {
    const std::size_t i = pixel_index(row, image.height, sampling.clamps_v) * image.width +
                          pixel_index(column, image.width, sampling.clamps_u);
    const std::uint8_t* p = &image.rgba[4 * i];
    const float alpha = static_cast<float>(p[3]) / 255.0f;
    if (!image.srgb) return glm::vec4(glm::vec3(p[0], p[1], p[2]) / 255.0f, alpha);
    const std::array<float, 256>& light = light_of_codes();
    return glm::vec4(light[p[0]], light[p[1]], light[p[2]], alpha);
  };
  if (nearest) return pixel(x, y);
  return glm::mix(glm::mix(pixel(x, y), pixel(x + 1, y), share.x),
                  glm::mix(pixel(x, y + 1), pixel(x + 1, y + 1), share.x), share.y);
}

}  // namespace septet::scene
