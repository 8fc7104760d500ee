#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <jpeglib.h>

#include "engine/image/jpeg.hpp"
#include "tests/why_not.hpp"

namespace septet::image {
namespace {

/// A picture as `encode_jpeg` does not write it: of `space`, progressive where asked.
Bytes written(J_COLOR_SPACE space, int components, bool progressive) {
  jpeg_compress_struct info{};
  jpeg_error_mgr errors{};
  info.err = jpeg_std_error(&errors);
  jpeg_create_compress(&info);
  unsigned char* out = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&info, &out, &size);
  info.image_width = 32;
  info.image_height = 24;
  info.input_components = components;
  info.in_color_space = space;
  jpeg_set_defaults(&info);
  if (progressive) jpeg_simple_progression(&info);
  jpeg_start_compress(&info, TRUE);
  std::vector<unsigned char> row(std::size_t{32} * static_cast<std::size_t>(components), 80);
  while (info.next_scanline < info.image_height) {
    JSAMPROW rows[] = {row.data()};
    jpeg_write_scanlines(&info, rows, 1);
  }
  jpeg_finish_compress(&info);
  const auto* const first = reinterpret_cast<const std::byte*>(out);
  Bytes bytes(first, first + size);
  jpeg_destroy_compress(&info);
  std::free(out);
  return bytes;
}

}  // namespace

TEST_CASE("a JPEG is the picture in its size, within a few codes where it is smooth, whatever its sides are") {
  for (const auto& [width, height] : {std::pair(640u, 374u), std::pair(1u, 1u), std::pair(17u, 3u)}) {
    Image picture(width, height);
    for (std::uint32_t y = 0; y < height; ++y)
      for (std::uint32_t x = 0; x < width; ++x)
        picture.set(x, y,
                    {static_cast<std::uint8_t>(x * 200 / 640), static_cast<std::uint8_t>(y * 200 / 640), 90, 255});
    const auto read = decode_jpeg(encode_jpeg(picture), "p.jpg");
    REQUIRE_MESSAGE(read.has_value(), why_not(read));
    const Image& back = *read;
    CHECK(back.width == width);
    CHECK(back.height == height);
    double sum = 0.0;
    for (std::size_t i = 0; i < picture.rgba.size(); ++i) sum += std::abs(int{picture.rgba[i]} - int{back.rgba[i]});
    CHECK(sum / static_cast<double>(picture.rgba.size()) < 6.0);
  }
}

TEST_CASE("a picture without pixels, or larger than any screen, gives no JPEG") {
  CHECK(encode_jpeg(Image{}).empty());
  CHECK(encode_jpeg(Image(16385, 1)).empty());
}

TEST_CASE("progressive and grey JPEGs are read, and one of four inks is refused") {
  for (const auto& [space, components] : {std::pair(JCS_RGB, 3), std::pair(JCS_GRAYSCALE, 1)})
    for (const bool progressive : {false, true}) {
      const auto read = decode_jpeg(written(space, components, progressive), "p.jpg");
      REQUIRE_MESSAGE(read.has_value(), why_not(read));
      CHECK(read->width == 32);
      CHECK(read->height == 24);
      CHECK(read->at(31, 23) == Color{80, 80, 80, 255});
    }
  const auto inks = decode_jpeg(written(JCS_CMYK, 4, false), "p.jpg");
  REQUIRE_FALSE(inks.has_value());
  CHECK(inks.error().what == "its JPEG has 4 colours a pixel");
}

TEST_CASE("a JPEG that is cut off anywhere is refused, and one with any byte changed is refused or keeps its size") {
  for (const bool progressive : {false, true}) {
    const Bytes whole = written(JCS_RGB, 3, progressive);
    for (std::size_t size = 0; size + 2 < whole.size(); ++size) {
      const auto read = decode_jpeg(std::span(whole).first(size), "p.jpg");
      CHECK_FALSE(read.has_value());
    }
    for (std::size_t i = 0; i < whole.size(); ++i) {
      Bytes changed = whole;
      changed[i] ^= std::byte{0x15};
      const auto read = decode_jpeg(changed, "p.jpg", 4096);
      if (read)
        CHECK(read->rgba.size() == std::size_t{4} * read->width * read->height);
      else
        CHECK_FALSE(read.error().remedy.empty());
    }
  }
}

TEST_CASE("a JPEG of more pixels a side than asked for is refused before it is read") {
  const auto read = decode_jpeg(written(JCS_RGB, 3, false), "p.jpg", 31);
  REQUIRE_FALSE(read.has_value());
  CHECK(read.error().what == "it is of 32 × 24 pixels, more than 31 a side");
  CHECK(read.error().where == "p.jpg");
}

}  // namespace septet::image
