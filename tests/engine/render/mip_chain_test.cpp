#include "engine/render/mip_chain.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>

#include "engine/core/random.hpp"
#include "tests/relative.hpp"

namespace septet::render {

TEST_CASE("levels halve down to one pixel for odd and even sizes") {
  const std::vector<MipLevel> levels = mip_chain(13, 4, std::vector<std::uint8_t>(13 * 4 * 4, 100), false);
  REQUIRE(levels.size() == 4);
  CHECK(levels[1].width == 6);
  CHECK(levels[1].height == 2);
  CHECK(levels[3].width == 1);
  CHECK(levels[3].height == 1);
}

TEST_CASE("black and white average to half the light and not to half the code") {
  const std::vector<std::uint8_t> stripes{0, 0, 0, 255, 255, 255, 255, 255, 0, 0, 0, 255, 255, 255, 255, 255};
  CHECK(mip_chain(2, 2, stripes, true)[1].rgba[0] == 188);  // sRGB code of one half.
  CHECK(mip_chain(2, 2, stripes, false)[1].rgba[0] == 128);
}

TEST_CASE("the colour of what is cut away does not bleed in") {
  const std::vector<std::uint8_t> leaf{40, 200, 40, 255, 255, 0, 255, 0, 40, 200, 40, 255, 255, 0, 255, 0};
  const std::vector<MipLevel> levels = mip_chain(2, 2, leaf, true);
  CHECK(levels[1].rgba[0] == relative(40, 0.03));
  CHECK(levels[1].rgba[1] == relative(200, 0.01));
}

TEST_CASE("foliage keeps the share that passes the cut on smaller levels") {
  Random random(5);
  std::vector<std::uint8_t> rgba;
  for (int i = 0; i < 64 * 64; ++i)
    rgba.insert(rgba.end(), {60, 90, 40, static_cast<std::uint8_t>(random.uniform() < 0.3 ? 255 : 0)});
  const std::vector<MipLevel> levels = mip_chain(64, 64, rgba, true);
  for (std::size_t level = 1; level <= 3; ++level) {
    int passing = 0;
    const std::size_t pixels = levels[level].rgba.size() / 4;
    for (std::size_t i = 0; i < pixels; ++i) passing += levels[level].rgba[4 * i + 3] >= 128;
    CHECK(static_cast<double>(passing) / static_cast<double>(pixels) == relative(0.3, 0.4));
  }
}

TEST_CASE("an alpha that is an opacity keeps its mean on smaller levels") {
  std::vector<std::uint8_t> rgba;
  for (int i = 0; i < 64 * 64; ++i) rgba.insert(rgba.end(), {255, 255, 255, static_cast<std::uint8_t>(4 * (i % 64))});
  const std::vector<MipLevel> levels = mip_chain(64, 64, rgba, true, Alpha::blends);
  CHECK(int(levels[6].rgba[3]) >= 125);
  CHECK(int(levels[6].rgba[3]) <= 129);
  CHECK(int(levels[4].rgba[3]) <= 32);
}

TEST_CASE("levels renewed from a rectangle are those of the whole image") {
  Random random(8);
  constexpr std::uint32_t width = 77, height = 42;
  std::vector<std::uint8_t> rgba(std::size_t{4} * width * height, 255);
  for (std::size_t i = 0; i < rgba.size(); ++i)
    if (i % 4 != 3) rgba[i] = static_cast<std::uint8_t>(random.below(256));
  std::vector<MipLevel> levels = mip_chain(width, height, rgba, true);
  for (int change = 0; change < 60; ++change) {
    const auto x = static_cast<std::uint32_t>(random.below(width)),
               y = static_cast<std::uint32_t>(random.below(height));
    const MipRect rect{x, y, std::min<std::uint32_t>(width - x, 1 + static_cast<std::uint32_t>(random.below(20))),
                       std::min<std::uint32_t>(height - y, 1 + static_cast<std::uint32_t>(random.below(9)))};
    for (std::uint32_t row = rect.y; row < rect.y + rect.height; ++row)
      for (std::uint32_t at = rect.x; at < rect.x + rect.width; ++at)
        for (std::size_t c = 0; c < 3; ++c)
          rgba[(std::size_t{row} * width + at) * 4 + c] = static_cast<std::uint8_t>(random.below(256));
    const std::vector<MipRect> rects = renew_mips(levels, rgba, rect, true);
    REQUIRE(rects.size() == levels.size());
    const std::vector<MipLevel> whole = mip_chain(width, height, rgba, true);
    for (std::size_t i = 1; i < whole.size(); ++i) REQUIRE(levels[i].rgba == whole[i].rgba);
  }
}

}  // namespace septet::render
