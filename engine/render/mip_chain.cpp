#include "engine/render/mip_chain.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/check.hpp"
#include "engine/image/srgb.hpp"

namespace septet::render {
namespace {

/// sRGB to linear (IEC 61966-2-1) and back, by tables; the way back has 4096 steps.
struct Transfer {
  std::array<float, 256> linear{};
  std::array<std::uint8_t, 4097> encoded{};

  explicit Transfer(bool srgb) {
    for (std::size_t i = 0; i < 256; ++i) linear[i] = static_cast<float>(linear_of_code(i, srgb));
    for (std::size_t i = 0; i < encoded.size(); ++i) {
      const double v = double(i) / 4096.0;
      const double code = srgb ? image::srgb_of_light(v) : v;
      encoded[i] = static_cast<std::uint8_t>(std::lround(255.0 * code));
    }
  }
  std::uint8_t encode(float value) const {
    // NOLINTNEXTLINE(bugprone-incorrect-roundings): never negative, and in a loop over pixels.
    return encoded[static_cast<std::size_t>(std::clamp(value, 0.0f, 1.0f) * 4096.0f + 0.5f)];
  }
};

const Transfer& transfer_of(bool srgb) {
  static const Transfer of_srgb(true), of_linear(false);  // Constants that take thousands of powers to compute.
  return srgb ? of_srgb : of_linear;
}

/// Pixels of a level that are owned by another.
struct SeenLevel {
  std::uint32_t width = 0, height = 0;
  std::span<const std::uint8_t> rgba;
};

/// Computes the pixels of `rect` of the next level.
void halve(const SeenLevel& from, MipLevel& to, const MipRect& rect, const Transfer& transfer) {
  for (std::uint32_t y = rect.y; y < rect.y + rect.height; ++y)
    for (std::uint32_t x = rect.x; x < rect.x + rect.width; ++x) {
      std::array<const std::uint8_t*, 4> from_pixels;
      for (std::uint32_t corner = 0; corner < 4; ++corner) {
        const std::uint32_t sx = std::min(2 * x + (corner & 1), from.width - 1);
        const std::uint32_t sy = std::min(2 * y + (corner >> 1), from.height - 1);
        from_pixels[corner] = &from.rgba[(std::size_t{sy} * from.width + sx) * 4];
      }
      int alpha = 0;
      for (const std::uint8_t* pixel : from_pixels) alpha += pixel[3];
      std::uint8_t* pixel = &to.rgba[(std::size_t{y} * to.width + x) * 4];
      for (std::size_t c = 0; c < 3; ++c) {
        float sum = 0.0f, weight = 0.0f;
        for (const std::uint8_t* part : from_pixels) {
          const float share = alpha > 0 ? part[3] : 1.0f;
          sum += transfer.linear[part[c]] * share;
          weight += share;
        }
        pixel[c] = transfer.encode(sum / weight);
      }
      pixel[3] = static_cast<std::uint8_t>((alpha + 2) / 4);
    }
}

MipLevel half(const MipLevel& from, const Transfer& transfer) {
  MipLevel to{std::max(1u, from.width / 2), std::max(1u, from.height / 2), {}};
  to.rgba.resize(std::size_t{4} * to.width * to.height);
  halve({from.width, from.height, from.rgba}, to, {0, 0, to.width, to.height}, transfer);
  return to;
}

constexpr std::uint8_t cut = 128;

double share_passing(std::span<const std::uint8_t> rgba, double scale) {
  std::size_t passing = 0;
  for (std::size_t i = 3; i < rgba.size(); i += 4) passing += rgba[i] * scale >= cut;
  return static_cast<double>(passing) / (static_cast<double>(rgba.size()) / 4.0);
}

void keep_coverage(std::vector<std::uint8_t>& rgba, double wanted) {
  double low = 0.25, high = 8.0;
  for (int step = 0; step < 10; ++step) {
    const double middle = 0.5 * (low + high);
    (share_passing(rgba, middle) < wanted ? low : high) = middle;
  }
  for (std::size_t i = 3; i < rgba.size(); i += 4) rgba[i] = static_cast<std::uint8_t>(std::min(255.0, rgba[i] * high));
}

}  // namespace

double linear_of_code(std::size_t code, bool srgb) {
  const double v = double(code) / 255.0;
  return srgb ? image::light_of_srgb(v) : v;
}

bool has_holes(std::span<const std::uint8_t> rgba) {
  for (std::size_t i = 3; i < rgba.size(); i += 4)
    if (rgba[i] < cut) return true;
  return false;
}

std::vector<MipRect> renew_mips(std::span<MipLevel> levels, std::span<const std::uint8_t> rgba, MipRect rect,
                                bool srgb) {
  const Transfer& transfer = transfer_of(srgb);
  std::vector<MipRect> rects{rect};
  for (std::size_t i = 1; i < levels.size(); ++i) {
    const MipLevel& from = levels[i - 1];
    MipLevel& to = levels[i];
    // Of an odd side, the last pixels have none below.
    const std::uint32_t x = std::min(rect.x / 2, to.width - 1), y = std::min(rect.y / 2, to.height - 1);
    const std::uint32_t right = std::min((rect.x + rect.width + 1) / 2, to.width),
                        lower = std::min((rect.y + rect.height + 1) / 2, to.height);
    rect = {x, y, std::max(right, x + 1) - x, std::max(lower, y + 1) - y};
    halve({from.width, from.height, i == 1 ? rgba : std::span<const std::uint8_t>(from.rgba)}, to, rect, transfer);
    rects.push_back(rect);
  }
  return rects;
}

std::vector<MipLevel> mip_chain(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba,
                                bool srgb, Alpha alpha) {
  SEPTET_CHECK(width > 0 && height > 0 && rgba.size() == std::size_t{4} * width * height, "{} × {} pixels in {} bytes",
               width, height, rgba.size());
  const Transfer& transfer = transfer_of(srgb);
  const bool holes = alpha == Alpha::cuts && has_holes(rgba);
  const double coverage = holes ? share_passing(rgba, 1.0) : 1.0;
  std::vector<MipLevel> levels{{width, height, {rgba.begin(), rgba.end()}}};
  MipLevel unscaled = levels.front();
  while (unscaled.width > 1 || unscaled.height > 1) {
    unscaled = half(unscaled, transfer);
    levels.push_back(unscaled);
    if (holes) keep_coverage(levels.back().rgba, coverage);
  }
  return levels;
}

}  // namespace septet::render
