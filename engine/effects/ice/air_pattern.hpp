#pragma once
/// The texture of the planes of air (section 3.1 of the paper): haze, and bubbles of random sizes.

#include <cstdint>
#include <span>
#include <vector>

namespace septet::ice {

/// Upper bound on a texel's opacity.
inline constexpr float most_air_opacity = 0.5f;

/// Opacity in 1/255 of most_air_opacity, row after row, of a square tile that repeats at its edges; haze lies where
/// `ranks`, a noise of 8 bits of the same size, is high. Each of `cells` times `cells` cells holds one bubble at most.
std::vector<std::uint8_t> air_pattern(std::span<const std::uint8_t> ranks, std::uint32_t side,
                                      std::uint32_t cells = 13);

}  // namespace septet::ice
