#include <optional>
#include <span>
#include <utility>

#include <doctest/doctest.h>

#include "engine/image/png.hpp"
#include "sim-client/screen/thumbnail_maker.hpp"

namespace septet::screen {

TEST_CASE("a thumbnail keeps the ratio of the sides within 160 by 120 pixels, also of pictures that are all edge") {
  const auto size = [](std::uint32_t width, std::uint32_t height) {
    const auto small = thumbnail_of(image::Image(width, height));
    return std::pair(small.width, small.height);
  };
  CHECK(size(1920, 1080) == std::pair(160u, 90u));
  CHECK(size(1080, 1920) == std::pair(68u, 120u));
  CHECK(size(100, 50) == std::pair(100u, 50u));
  CHECK(size(16000, 3) == std::pair(160u, 1u));
  CHECK(size(1, 16000) == std::pair(1u, 120u));
}

TEST_CASE("a thumbnail's pixel is the mean of those that it stands for") {
  image::Image picture(640, 320);
  for (std::uint32_t y = 0; y < 320; ++y)
    for (std::uint32_t x = 0; x < 640; ++x) picture.set(x, y, {static_cast<std::uint8_t>(x % 2 * 200), 10, 30, 255});
  const auto small = thumbnail_of(picture);
  CHECK(small.width == 160);
  CHECK(small.at(80, 40) == image::Color{100, 10, 30, 255});
}

TEST_CASE("a thumbnail is sent once, as a PNG below its limit") {
  ThumbnailMaker maker;
  maker.take(7, image::Image(1920, 1080, {10, 20, 30, 255}));
  std::optional<control::Thumbnail> made;
  while (!made) made = maker.finished();
  CHECK(made->tick == 7);
  CHECK(made->png.size() < control::most_thumbnail_bytes);
  const auto read = image::decode_png(std::as_bytes(std::span(made->png)), "test");
  REQUIRE(read.has_value());
  CHECK(read->at(5, 5) == image::Color{10, 20, 30, 255});
  CHECK_FALSE(maker.finished().has_value());
}

}  // namespace septet::screen
