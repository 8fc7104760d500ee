#include "sim-client/film/traced/kept_tiles.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace septet::film {
namespace {

off_t place_of(std::uint32_t tile) {
  return static_cast<off_t>(tile * encoded_tile_size(std::size_t{tile_side_px} * tile_side_px));
}

}  // namespace

Expected<KeptTiles> KeptTiles::open(const std::filesystem::path& file, std::span<const instant::PixelRectangle> tiles) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0)
    return failure(std::generic_category().message(errno), file.string(), "check the folder and its permissions");
  return KeptTiles(file, descriptor, tiles);
}

KeptTiles::KeptTiles(KeptTiles&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)), tiles_(other.tiles_) {}

KeptTiles::~KeptTiles() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Expected<void> KeptTiles::put(std::uint32_t tile, std::span<const std::byte> encoded) {
  off_t at = place_of(tile);
  while (!encoded.empty()) {
    const ssize_t written = ::pwrite(descriptor_, encoded.data(), encoded.size(), at);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0)
      return failure(std::generic_category().message(written < 0 ? errno : ENOSPC), file_.string(),
                     "make room and add --resume to go on: what is finished is kept");
    at += written;
    encoded = encoded.subspan(static_cast<std::size_t>(written));
  }
  return {};
}

std::optional<TracedTile> KeptTiles::read(std::uint32_t tile) const {
  Bytes bytes(encoded_tile_size(pixels_of(tile)));
  for (std::size_t there = 0; there < bytes.size();) {
    const ssize_t read =
        ::pread(descriptor_, bytes.data() + there, bytes.size() - there, place_of(tile) + static_cast<off_t>(there));
    if (read < 0 && errno == EINTR) continue;
    if (read <= 0) return std::nullopt;
    there += static_cast<std::size_t>(read);
  }
  return decode_tile(bytes, pixels_of(tile));
}

}  // namespace septet::film
