#include <cmath>
#include <cstdio>
#include <vector>

#include <doctest/doctest.h>
#include <jpeglib.h>

#include "engine/image/jpeg.hpp"

namespace septet::image {
namespace {

Image decoded(const Bytes& bytes) {
  jpeg_decompress_struct info{};
  jpeg_error_mgr errors{};
  info.err = jpeg_std_error(&errors);
  jpeg_create_decompress(&info);
  jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  jpeg_read_header(&info, TRUE);
  jpeg_start_decompress(&info);
  Image image(info.output_width, info.output_height);
  std::vector<unsigned char> row(std::size_t{3} * info.output_width);
  while (info.output_scanline < info.output_height) {
    const std::uint32_t y = info.output_scanline;
    JSAMPROW rows[] = {row.data()};
    jpeg_read_scanlines(&info, rows, 1);
    for (std::uint32_t x = 0; x < image.width; ++x) image.set(x, y, {row[3 * x], row[3 * x + 1], row[3 * x + 2], 255});
  }
  jpeg_finish_decompress(&info);
  jpeg_destroy_decompress(&info);
  return image;
}

}  // namespace

TEST_CASE("a JPEG is the picture in its size, within a few codes where it is smooth, whatever its sides are") {
  for (const auto& [width, height] : {std::pair(640u, 374u), std::pair(1u, 1u), std::pair(17u, 3u)}) {
    Image picture(width, height);
    for (std::uint32_t y = 0; y < height; ++y)
      for (std::uint32_t x = 0; x < width; ++x)
        picture.set(x, y,
                    {static_cast<std::uint8_t>(x * 200 / 640), static_cast<std::uint8_t>(y * 200 / 640), 90, 255});
    const Image back = decoded(encode_jpeg(picture));
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

}  // namespace septet::image
