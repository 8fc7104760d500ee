#include "engine/effects/ice/air_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/core/check.hpp"
#include "engine/core/random.hpp"

namespace septet::ice {
namespace {

/// Places in cells.
struct Bubble {
  float x = 0.0f, y = 0.0f, radius = 0.0f;
};

float smooth_step(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

std::vector<Bubble> bubbles(std::uint32_t cells) {
  std::vector<Bubble> made;
  Random random(17, 3);
  for (std::uint32_t y = 0; y < cells; ++y)
    for (std::uint32_t x = 0; x < cells; ++x) {
      const double size = random.uniform(), right = random.uniform(0.25, 0.75), down = random.uniform(0.25, 0.75);
      if (size > 0.72)
        made.push_back({static_cast<float>(x + right), static_cast<float>(y + down),
                        static_cast<float>(0.06 + 0.5 * (size - 0.72))});
    }
  return made;
}

}  // namespace

std::vector<std::uint8_t> air_pattern(std::span<const std::uint8_t> ranks, std::uint32_t side, std::uint32_t cells) {
  SEPTET_CHECK(ranks.size() == std::size_t{side} * side && cells > 0, "{} ranks for {} × {} texels", ranks.size(), side,
               side);
  std::vector<float> opacity(ranks.size());
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    const float rank = static_cast<float>(ranks[i]) / 255.0f;
    opacity[i] = 0.07f * smooth_step(0.55f, 1.0f, rank * rank);
  }
  const float texels_per_cell = static_cast<float>(side) / static_cast<float>(cells);
  for (const Bubble& bubble : bubbles(cells)) {
    const float radius = bubble.radius * texels_per_cell, x = bubble.x * texels_per_cell,
                y = bubble.y * texels_per_cell;
    const auto reach = static_cast<int>(std::ceil(radius)) + 1;
    // A bubble's cell is wide enough that it never reaches over the tile's edge.
    for (int j = static_cast<int>(y) - reach; j <= static_cast<int>(y) + reach; ++j)
      for (int i = static_cast<int>(x) - reach; i <= static_cast<int>(x) + reach; ++i) {
        if (i < 0 || j < 0 || i >= static_cast<int>(side) || j >= static_cast<int>(side)) continue;
        const float away = std::hypot(static_cast<float>(i) + 0.5f - x, static_cast<float>(j) + 0.5f - y);
        opacity[static_cast<std::size_t>(j) * side + static_cast<std::size_t>(i)] +=
            0.35f * (1.0f - smooth_step(0.6f * radius, radius, away));
      }
  }
  std::vector<std::uint8_t> texels;
  texels.reserve(opacity.size());
  for (const float each : opacity)
    texels.push_back(static_cast<std::uint8_t>(std::lround(255.0f * std::min(each / most_air_opacity, 1.0f))));
  return texels;
}

}  // namespace septet::ice
