#include "engine/image/jpeg.hpp"

#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <jpeglib.h>

#include <jerror.h>

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

/// A progressive picture has about ten passes; a hostile one thousands, each over all its pixels.
constexpr int most_passes = 100;

/// libjpeg fills what is missing with grey and warns of it: such a picture is refused.
void warn(j_common_ptr info, int level) {
  const int code = info->err->msg_code;
  if (level < 0 && (code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER || code == JWRN_HUFF_BAD_CODE)) fail(info);
}

void limit_passes(j_common_ptr info) {
  if (reinterpret_cast<j_decompress_ptr>(info)->input_scan_number > most_passes) fail(info);
}

/// A picture that is being read. libjpeg holds addresses of its members.
struct Reading {
  jpeg_decompress_struct info{};
  jpeg_progress_mgr progress{};
  Failure failure{};

  Reading() = default;
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;
  ~Reading() { jpeg_destroy_decompress(&info); }
};

/// As `write`: a jump leaves it. False where the bytes are no JPEG's.
bool read_header(Reading& reading, std::span<const std::byte> bytes) {
  reading.info.err = jpeg_std_error(&reading.failure.manager);
  reading.failure.manager.error_exit = fail;
  reading.failure.manager.emit_message = warn;
  reading.failure.manager.output_message = say_nothing;
  if (setjmp(reading.failure.back) != 0) return false;
  jpeg_create_decompress(&reading.info);
  reading.progress.progress_monitor = limit_passes;
  reading.info.progress = &reading.progress;
  jpeg_mem_src(&reading.info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  return jpeg_read_header(&reading.info, TRUE) == JPEG_HEADER_OK;
}

/// As `write`: a jump leaves it. False where the pixels are damaged; the reason is then the manager's message.
bool read_pixels(Reading& reading, std::uint8_t* rgba) {
  if (setjmp(reading.failure.back) != 0) return false;
  reading.info.out_color_space = JCS_EXT_RGBA;
  jpeg_start_decompress(&reading.info);
  while (reading.info.output_scanline < reading.info.output_height) {
    JSAMPROW rows[] = {rgba + std::size_t{4} * reading.info.output_width * reading.info.output_scanline};
    jpeg_read_scanlines(&reading.info, rows, 1);
  }
  jpeg_finish_decompress(&reading.info);
  return true;
}

}  // namespace

bool begins_as_jpeg(std::span<const std::byte> bytes) {
  return bytes.size() >= 3 && bytes[0] == std::byte{0xFF} && bytes[1] == std::byte{0xD8} && bytes[2] == std::byte{0xFF};
}

Expected<Image> decode_jpeg(std::span<const std::byte> bytes, std::string_view where, std::uint32_t most_px) {
  const std::string place(where);
  constexpr const char* save_anew = "save the picture anew as an RGB JPEG or a PNG";
  Reading reading;
  if (bytes.empty() || !read_header(reading, bytes)) return failure("it is no whole JPEG", place, save_anew);
  const std::uint32_t width = reading.info.image_width, height = reading.info.image_height;
  if (width > most_px || height > most_px)
    return failure(fmt::format("it is of {} × {} pixels, more than {} a side", width, height, most_px), place,
                   "make it smaller");
  if (reading.info.num_components != 1 && reading.info.num_components != 3)
    return failure(fmt::format("its JPEG has {} colours a pixel", reading.info.num_components), place, save_anew);
  Image image(width, height);
  if (!read_pixels(reading, image.rgba.data())) return failure("its JPEG is cut off or damaged", place, save_anew);
  return image;
}

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
