#include "engine/image/png.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include <png.h>

#include "engine/core/whole_file.hpp"

namespace septet::image {
namespace {

constexpr std::uint32_t largest_side_px = 16384;

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

tl::unexpected<Error> file_failure(const std::string& what, const std::filesystem::path& path,
                                   const char* remedy = "check that the folder exists and can be written") {
  return failure(what + ": " + std::strerror(errno), path.string(), remedy);
}
constexpr const char* check_that_it_can_be_read = "check that the file exists and can be read";

}  // namespace

Bytes encode_png(const Image& image, PngEffort effort) {
  SEPTET_CHECK(image.width > 0 && image.height > 0, "{} × {}", image.width, image.height);
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = image.width;
  header.height = image.height;
  header.format = PNG_FORMAT_RGBA;
  if (effort == PngEffort::fast) header.flags = PNG_IMAGE_FLAG_FAST;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  Bytes bytes(size);
  const int written = png_image_write_to_memory(&header, bytes.data(), &size, 0, image.rgba.data(), 0, nullptr);
  SEPTET_CHECK(written != 0, "libpng: {}", header.message);
  bytes.resize(size);
  return bytes;
}

Expected<Image> decode_png(std::span<const std::byte> bytes, std::string_view where) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  const auto refused = [&] {
    std::string message = header.message;
    png_image_free(&header);
    return failure("not a readable PNG (" + message + ")", std::string(where), "give a PNG file");
  };
  if (png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) == 0) return refused();
  if (header.width > largest_side_px || header.height > largest_side_px) {
    png_image_free(&header);
    return failure("the image is larger than 16384 pixels a side", std::string(where), "give a smaller image");
  }
  header.format = PNG_FORMAT_RGBA;
  Image image(header.width, header.height);
  if (png_image_finish_read(&header, nullptr, image.rgba.data(), 0, nullptr) == 0) return refused();
  return image;
}

Expected<void> write_png(const std::filesystem::path& path, const Image& image, PngEffort effort) {
  return write_whole_file(path, "image", encode_png(image, effort));
}

Expected<Image> read_png(const std::filesystem::path& path) {
  File file(std::fopen(path.c_str(), "rb"));
  if (!file) return file_failure("cannot open the image", path, check_that_it_can_be_read);
  Bytes bytes;
  std::byte chunk[65536];
  while (const std::size_t count = std::fread(chunk, 1, sizeof chunk, file.get()))
    bytes.insert(bytes.end(), chunk, chunk + count);
  if (std::ferror(file.get())) return file_failure("cannot read the image", path, check_that_it_can_be_read);
  return decode_png(bytes, path.string());
}

}  // namespace septet::image
