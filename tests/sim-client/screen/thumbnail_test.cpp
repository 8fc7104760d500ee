#include <optional>
#include <utility>

#include <doctest/doctest.h>

#include "sim-client/screen/thumbnail_maker.hpp"

namespace septet::screen {

TEST_CASE("a thumbnail keeps the ratio of the sides within its limits, also of pictures that are all edge") {
  const auto size = [](std::uint32_t width, std::uint32_t height, const PictureLimits& limits = {}) {
    const auto small = thumbnail_of(image::Image(width, height), limits);
    return std::pair(small.width, small.height);
  };
  CHECK(size(1920, 1080) == std::pair(320u, 180u));
  CHECK(size(1080, 1920) == std::pair(135u, 240u));
  CHECK(size(100, 50) == std::pair(100u, 50u));
  CHECK(size(16000, 3) == std::pair(320u, 1u));
  CHECK(size(1, 16000) == std::pair(1u, 240u));
  CHECK(size(1280, 747, large_picture) == std::pair(960u, 560u));
  CHECK(size(640, 374, large_picture) == std::pair(640u, 374u));
}

TEST_CASE("a thumbnail's pixel is the mean of those that it stands for") {
  image::Image picture(1280, 640);
  for (std::uint32_t y = 0; y < 640; ++y)
    for (std::uint32_t x = 0; x < 1280; ++x) picture.set(x, y, {static_cast<std::uint8_t>(x % 2 * 200), 10, 30, 255});
  const auto small = thumbnail_of(picture);
  CHECK(small.width == 320);
  CHECK(small.at(80, 40) == image::Color{100, 10, 30, 255});
}

TEST_CASE("a thumbnail is sent once, as a JPEG below its limit, also of noise") {
  image::Image noise(1920, 1080);
  std::uint32_t random = 1;
  for (std::uint8_t& value : noise.rgba)
    value = static_cast<std::uint8_t>((random = random * 1664525u + 1013904223u) >> 24);
  for (const PictureLimits& limits : {PictureLimits{}, large_picture}) {
    ThumbnailMaker maker(limits);
    maker.take(7, noise);
    std::optional<ThumbnailMaker::Made> made;
    while (!made) made = maker.finished();
    CHECK(made->tick == 7);
    CHECK(made->picture.size() < limits.bytes);
    CHECK(made->picture.starts_with("\xff\xd8"));
    CHECK_FALSE(maker.finished().has_value());
  }
}

}  // namespace septet::screen
