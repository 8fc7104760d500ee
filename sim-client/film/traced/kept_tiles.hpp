#pragma once
/// Tiles of an unfinished frame, in a file beside the pictures: tiles finished by a killed program are not traced
/// again.
///
/// Each tile has its place in the file and a hash; a place never written, or half written, counts as empty. One thread.

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "engine/instant/view.hpp"
#include "sim-client/film/traced/messages.hpp"

namespace septet::film {

class KeptTiles {
 public:
  /// Creates the file, or opens the present one.
  static Expected<KeptTiles> open(const std::filesystem::path& file, std::span<const instant::PixelRectangle> tiles);
  KeptTiles(KeptTiles&& other) noexcept;
  KeptTiles& operator=(KeptTiles&&) = delete;
  ~KeptTiles();

  /// Keeps a tile that encode_tile has encoded. Error: the disk is full.
  Expected<void> put(std::uint32_t tile, std::span<const std::byte> encoded);
  /// Returns the tile; empty if it is not there.
  std::optional<TracedTile> read(std::uint32_t tile) const;

 private:
  KeptTiles(std::filesystem::path file, int descriptor, std::span<const instant::PixelRectangle> tiles)
      : file_(std::move(file)), descriptor_(descriptor), tiles_(tiles) {}
  std::size_t pixels_of(std::uint32_t tile) const { return std::size_t{tiles_[tile].width} * tiles_[tile].height; }

  std::filesystem::path file_;
  int descriptor_;
  std::span<const instant::PixelRectangle> tiles_;
};

}  // namespace septet::film
