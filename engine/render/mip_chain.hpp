#pragma once
/// Mip levels of an image: box-filtered in linear light, colours weighted by alpha.
///
/// Where alpha cuts holes (leaves, fences), each level's alpha is scaled until as much of it passes the cut as in the
/// full image, so that trees do not thin out with distance (Castaño, "Computing Alpha Mipmaps", 2010). Where it is an
/// opacity it keeps its mean.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace septet::render {

struct MipLevel {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

/// Linear light of an 8-bit code (IEC 61966-2-1, or the code itself over 255).
double linear_of_code(std::size_t code, bool srgb);

enum class Alpha : std::uint8_t { cuts, blends };

/// All levels, the full image first, down to 1 × 1.
std::vector<MipLevel> mip_chain(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba,
                                bool srgb, Alpha alpha = Alpha::cuts);

/// Rectangle of pixels of each level.
struct MipRect {
  std::uint32_t x = 0, y = 0, width = 0, height = 0;
};

/// Renews the levels below the full image, from a rectangle of it that changed; returns the changed rectangle of every
/// level, the full image's first. `levels` is a chain of an image without holes, whose first level may be without pixels
/// since `rgba` holds them.
std::vector<MipRect> renew_mips(std::span<MipLevel> levels, std::span<const std::uint8_t> rgba, MipRect rect,
                                bool srgb);

/// True if any pixel falls below the cut at ½.
bool has_holes(std::span<const std::uint8_t> rgba);

}  // namespace septet::render
