#include "engine/scene/bitmap_image.hpp"

#include <doctest/doctest.h>

#include <bit>

using namespace septet;
using namespace septet::scene;

namespace {

Node bitmap_of(PixelType type, std::vector<std::uint8_t> tiles, std::uint32_t width = 8, std::uint32_t height = 1) {
  Node node;
  BitmapData bitmap{.width = width, .height = height};
  bitmap.layers[0] = {"color_g", type, std::move(tiles)};
  node.data = bitmap;
  return node;
}

std::uint8_t green(const TextureImage& image, std::uint32_t x, std::uint32_t y) {
  return image.rgba[(std::size_t{y} * image.width + x) * 4 + 1];
}

template <class Unsigned>
void put(std::vector<std::uint8_t>& tile, std::size_t pixel, Unsigned bits) {
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i)
    tile[pixel * sizeof(Unsigned) + i] = static_cast<std::uint8_t>(bits >> (8 * i));
}

}  // namespace

TEST_CASE("pixels of every type become bytes") {
  std::vector<std::uint8_t> bits(8, 0);
  bits[0] = 0b00000101;
  const TextureImage of_bits = image_of_bitmap(bitmap_of(PixelType::bit, bits));
  CHECK(green(of_bits, 0, 0) == 255);
  CHECK(green(of_bits, 1, 0) == 0);
  CHECK(green(of_bits, 2, 0) == 255);

  std::vector<std::uint8_t> words(128, 0);
  put<std::uint16_t>(words, 0, 0xFFFF), put<std::uint16_t>(words, 1, 0x8080), put<std::uint16_t>(words, 2, 0x00FF);
  const TextureImage of_words = image_of_bitmap(bitmap_of(PixelType::word, words));
  CHECK(green(of_words, 0, 0) == 255);
  CHECK(green(of_words, 1, 0) == 128);
  CHECK(green(of_words, 2, 0) == 1);

  std::vector<std::uint8_t> floats(256, 0), doubles(512, 0);
  const std::vector<double> values = {0.5, 2.0, -1.0, std::nan(""), 0.2};
  for (std::size_t i = 0; i < values.size(); ++i) {
    put(floats, i, std::bit_cast<std::uint32_t>(static_cast<float>(values[i])));
    put(doubles, i, std::bit_cast<std::uint64_t>(values[i]));
  }
  for (const TextureImage& image : {image_of_bitmap(bitmap_of(PixelType::real32, floats)),
                                    image_of_bitmap(bitmap_of(PixelType::real64, doubles))}) {
    CHECK(green(image, 0, 0) == 128);
    CHECK(green(image, 1, 0) == 255);
    CHECK(green(image, 2, 0) == 0);
    CHECK(green(image, 3, 0) == 0);
    CHECK(green(image, 4, 0) == 51);
  }
}

TEST_CASE("tiles lie row by row and what pads them is not shown") {
  std::vector<std::uint8_t> tiles(6 * 64);
  for (std::size_t tile = 0; tile < 6; ++tile)
    for (std::size_t pixel = 0; pixel < 64; ++pixel)
      tiles[tile * 64 + pixel] = static_cast<std::uint8_t>(tile * 40 + pixel % 40);
  const TextureImage image = image_of_bitmap(bitmap_of(PixelType::byte, tiles, 17, 9));
  CHECK(image.rgba.size() == 17 * 9 * 4);
  CHECK(green(image, 0, 0) == 0);
  CHECK(green(image, 9, 1) == 1 * 40 + 9);
  CHECK(green(image, 16, 0) == 2 * 40);
  CHECK(green(image, 0, 8) == 3 * 40);
  CHECK(green(image, 16, 8) == 5 * 40);
  // Opaque without an alpha layer; the other colours are black.
  CHECK(image.rgba[0] == 0);
  CHECK(image.rgba[3] == 255);
  CHECK(image.srgb);
}
