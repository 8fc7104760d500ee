#include "engine/gltf/alpha_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace septet::gltf {

void move_cutoff(image::Image& picture, float cutoff) {
  if (cutoff == cuts_below) return;
  for (std::size_t i = 3; i < picture.rgba.size(); i += 4) {
    const float alpha = static_cast<float>(picture.rgba[i]) / 255.0f;
    const float moved = alpha < cutoff ? cuts_below * alpha / cutoff
                                       : 1.0f - (1.0f - cuts_below) * (1.0f - alpha) / std::max(1.0f - cutoff, 1e-3f);
    const float code = std::clamp(255.0f * moved, 0.0f, 255.0f);
    picture.rgba[i] = static_cast<std::uint8_t>(alpha < cutoff ? std::min(std::floor(code), 127.0f)
                                                               : std::max(std::ceil(code), 128.0f));
  }
}

bool is_see_through(const image::Image& picture) {
  std::size_t there = 0, half_there = 0;
  for (std::size_t i = 3; i < picture.rgba.size(); i += 4) {
    constexpr std::uint8_t gone = 16, whole = 240;
    there += picture.rgba[i] >= gone ? 1u : 0u;
    half_there += picture.rgba[i] >= gone && picture.rgba[i] < whole ? 1u : 0u;
  }
  return 10 * half_there > there;
}

}  // namespace septet::gltf
