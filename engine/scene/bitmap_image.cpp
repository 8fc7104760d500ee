#include "engine/scene/bitmap_image.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace septet::scene {
namespace {

template <class Unsigned>
Unsigned little_endian(const std::uint8_t* bytes) {
  Unsigned value = 0;
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) value |= static_cast<Unsigned>(Unsigned{bytes[i]} << (8 * i));
  return value;
}

std::uint8_t byte_of_unit(double value) {
  if (!(value > 0.0)) return 0;  // NaN gives 0, too.
  return static_cast<std::uint8_t>(std::lround(std::min(value, 1.0) * 255.0));
}

/// Pixel `i` (row by row) of a tile.
std::uint8_t pixel(PixelType type, const std::uint8_t* tile, std::uint32_t i) {
  switch (type) {
    case PixelType::bit:
      return tile[i / 8] >> (i % 8) & 1 ? 255 : 0;
    case PixelType::byte:
      return tile[i];
    case PixelType::word:
      return byte_of_unit(little_endian<std::uint16_t>(tile + i * 2) / 65535.0);
    case PixelType::real32:
      return byte_of_unit(std::bit_cast<float>(little_endian<std::uint32_t>(tile + i * 4)));
    case PixelType::real64:
      return byte_of_unit(std::bit_cast<double>(little_endian<std::uint64_t>(tile + i * 8)));
  }
  return 0;
}

void fill_channel(TextureImage& image, std::size_t channel, const BitmapLayer& layer) {
  const std::size_t columns = tile_columns(image.width);
  const PixelType type = layer.type;
  for (std::uint32_t y = 0; y < image.height; ++y)
    for (std::uint32_t left = 0; left < image.width; left += tile_side) {
      const std::size_t tile = (y / tile_side) * columns + left / tile_side;
      const std::uint8_t* pixels = &layer.tiles[tile * tile_bytes(type)];
      std::uint8_t* target = &image.rgba[(std::size_t{y} * image.width + left) * 4 + channel];
      const std::uint32_t count = std::min<std::uint32_t>(tile_side, image.width - left);
      for (std::uint32_t x = 0; x < count; ++x) target[4 * x] = pixel(type, pixels, y % tile_side * tile_side + x);
    }
}

}  // namespace

TextureImage image_of_bitmap(const Node& node) {
  TextureImage image;
  const auto* bitmap = std::get_if<BitmapData>(&node.data);
  if (!bitmap) return image;
  if (const TagValue* srgb = find_tag(node, "image", "srgb"))
    if (const bool* value = std::get_if<bool>(srgb)) image.srgb = *value;
  const std::array<const BitmapLayer*, 4> channels = {find_layer(*bitmap, "color_r"), find_layer(*bitmap, "color_g"),
                                                      find_layer(*bitmap, "color_b"), find_layer(*bitmap, "alpha")};
  if ((!channels[0] && !channels[1] && !channels[2]) || bitmap->depth == 0) return image;
  image.width = bitmap->width;
  image.height = bitmap->height;
  image.rgba.assign(std::size_t{image.width} * image.height * 4, 0);
  if (!channels[3])
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
  for (std::size_t c = 0; c < 4; ++c)
    if (channels[c]) fill_channel(image, c, *channels[c]);
  return image;
}

}  // namespace septet::scene
