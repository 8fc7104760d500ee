#include "engine/image/jpeg.hpp"

#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <jpeglib.h>

namespace septet::image {
namespace {

constexpr std::uint32_t most_pixels_a_side = 16384;

/// libjpeg ends the program at an error unless a handler jumps out of it.
struct Failure {
  jpeg_error_mgr manager;
  std::jmp_buf back;
};

[[noreturn]] void fail(j_common_ptr info) { std::longjmp(reinterpret_cast<Failure*>(info->err)->back, 1); }
void say_nothing(j_common_ptr) {}

/// All code without destructors: a jump leaves it. Returns true where `out` holds the file.
bool write(const Image& image, int quality, std::byte* row, unsigned char*& out, unsigned long& size) {
  jpeg_compress_struct info{};
  Failure failure{};
  info.err = jpeg_std_error(&failure.manager);
  failure.manager.error_exit = fail;
  failure.manager.output_message = say_nothing;
  if (setjmp(failure.back) != 0) {
    jpeg_destroy_compress(&info);
    return false;
  }
  jpeg_create_compress(&info);
  jpeg_mem_dest(&info, &out, &size);
  info.image_width = image.width;
  info.image_height = image.height;
  info.input_components = 3;
  info.in_color_space = JCS_RGB;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, quality, TRUE);
  jpeg_start_compress(&info, TRUE);
  while (info.next_scanline < info.image_height) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const Color color = image.at(x, info.next_scanline);
      row[3 * x] = std::byte{color.red};
      row[3 * x + 1] = std::byte{color.green};
      row[3 * x + 2] = std::byte{color.blue};
    }
    JSAMPROW rows[] = {reinterpret_cast<JSAMPROW>(row)};
    jpeg_write_scanlines(&info, rows, 1);
  }
  jpeg_finish_compress(&info);
  jpeg_destroy_compress(&info);
  return true;
}

}  // namespace

Bytes encode_jpeg(const Image& image, int quality) {
  if (image.width == 0 || image.height == 0 || image.width > most_pixels_a_side || image.height > most_pixels_a_side)
    return {};
  std::vector<std::byte> row(std::size_t{3} * image.width);
  unsigned char* out = nullptr;
  unsigned long size = 0;
  const bool is_whole = write(image, quality, row.data(), out, size);
  Bytes bytes;
  if (is_whole) {
    const auto* const first = reinterpret_cast<const std::byte*>(out);
    bytes.assign(first, first + size);
  }
  std::free(out);
  return bytes;
}

}  // namespace septet::image
