#include "engine/image/png.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include <png.h>

namespace septet::image {
namespace {

constexpr std::uint32_t largest_side_px = 16384;

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

tl::unexpected<Error> file_failure(const std::string& what, const std::filesystem::path& path) {
  const int reason = errno;
  std::string remedy = "check that the folder exists and can be written";
  if (reason == ENOSPC) remedy = "free some space on the disk";
  return failure(what + ": " + std::strerror(reason), path.string(), std::move(remedy));
}

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

namespace {

/// Into that place; a failure names the picture's own path.
Expected<void> write_bytes(const std::filesystem::path& place, const std::filesystem::path& path, const Bytes& bytes) {
  File file(std::fopen(place.c_str(), "wb"));
  if (!file) return file_failure("cannot create the image", path);
  const bool written =
      std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size() && std::fflush(file.get()) == 0;
  if (!written) return file_failure("cannot write the image", path);
  // The last error of a full disk or a network file system may come only here.
  if (std::fclose(file.release()) != 0) return file_failure("cannot write the image", path);
  return {};
}

}  // namespace

Expected<void> write_png(const std::filesystem::path& path, const Image& image, PngEffort effort) {
  namespace fs = std::filesystem;
  const Bytes bytes = encode_png(image, effort);
  std::error_code error, ignored;
  // A device or a pipe is written to; a file's place is taken by one that is whole.
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored)) return write_bytes(path, path, bytes);
  const fs::path part = path.string() + ".part";
  auto written = write_bytes(part, path, bytes);
  if (written) {
    fs::rename(part, path, error);
    if (!error) return {};
    written = failure(error.message(), path.string(), "check the folder and its permissions");
  }
  fs::remove(part, ignored);
  return written;
}

Expected<Image> read_png(const std::filesystem::path& path) {
  File file(std::fopen(path.c_str(), "rb"));
  if (!file) return file_failure("cannot open the image", path);
  Bytes bytes;
  std::byte chunk[65536];
  while (const std::size_t count = std::fread(chunk, 1, sizeof chunk, file.get()))
    bytes.insert(bytes.end(), chunk, chunk + count);
  if (std::ferror(file.get())) return file_failure("cannot read the image", path);
  return decode_png(bytes, path.string());
}

}  // namespace septet::image
