#include "engine/scene/bitmap_image.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string_view>

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

/// `rect` begins at a tile's corner.
void fill_channel(TextureImage& image, std::size_t channel, const BitmapLayer& layer, const PixelRect& rect) {
  const std::size_t columns = tile_columns(image.width);
  const PixelType type = layer.type;
  for (std::uint32_t y = rect.y; y < rect.y + rect.height; ++y)
    for (std::uint32_t left = rect.x; left < rect.x + rect.width; left += tile_side) {
      const std::size_t tile = (y / tile_side) * columns + left / tile_side;
      const std::uint8_t* pixels = &layer.tiles[tile * tile_bytes(type)];
      std::uint8_t* target = &image.rgba[(std::size_t{y} * image.width + left) * 4 + channel];
      const std::uint32_t count = std::min<std::uint32_t>(tile_side, image.width - left);
      for (std::uint32_t x = 0; x < count; ++x) target[4 * x] = pixel(type, pixels, y % tile_side * tile_side + x);
    }
}

bool is_tagged(const Node& node, const char* name, bool otherwise) {
  const TagValue* tag = find_tag(node, "image", name);
  const bool* value = tag ? std::get_if<bool>(tag) : nullptr;
  return value ? *value : otherwise;
}

using Channels = std::array<const BitmapLayer*, 4>;
constexpr std::array<std::string_view, 3> usual_layers{"color_r", "color_g", "color_b"};
Channels channels_of(const BitmapData& bitmap, const std::array<std::string_view, 3>& layers = usual_layers) {
  const auto layer = [&](std::size_t c) { return find_layer(bitmap, layers[c].empty() ? usual_layers[c] : layers[c]); };
  return {layer(0), layer(1), layer(2), find_layer(bitmap, "alpha")};
}

}  // namespace

std::optional<PixelRect> renew_tiles(TextureImage& image, const Node& node, PartId layer, std::uint32_t first_tile,
                                     std::uint32_t tiles) {
  const auto* bitmap = std::get_if<BitmapData>(&node.data);
  if (!bitmap || image.rgba.empty() || image.width != bitmap->width || image.height != bitmap->height)
    return std::nullopt;
  const auto changed = bitmap->layers.find(layer);
  if (changed == bitmap->layers.end()) return std::nullopt;
  const Channels channels = channels_of(*bitmap);
  const auto channel = std::ranges::find(channels, &changed->second);
  const auto columns = static_cast<std::uint32_t>(tile_columns(image.width));
  const std::uint64_t first = first_tile,
                      end = std::min<std::uint64_t>(first + tiles, tile_count(image.width, image.height, 1));
  if (channel == channels.end() || first >= end) return PixelRect{};
  const auto first_row = static_cast<std::uint32_t>(first / columns),
             last_row = static_cast<std::uint32_t>((end - 1) / columns);
  PixelRect rect{0, first_row * tile_side, image.width, (last_row - first_row + 1) * tile_side};
  if (first_row == last_row) {
    rect.x = static_cast<std::uint32_t>(first % columns) * tile_side;
    rect.width = static_cast<std::uint32_t>(end - first) * tile_side;
  }
  rect.width = std::min(rect.width, image.width - rect.x);
  rect.height = std::min(rect.height, image.height - rect.y);
  fill_channel(image, static_cast<std::size_t>(channel - channels.begin()), changed->second, rect);
  return rect;
}

TextureImage image_of_bitmap(const Node& node) { return image_of_layers(node, usual_layers); }

TextureImage image_of_layers(const Node& node, const std::array<std::string_view, 3>& layers) {
  TextureImage image;
  const auto* bitmap = std::get_if<BitmapData>(&node.data);
  if (!bitmap) return image;
  image.srgb = is_tagged(node, "srgb", true);
  image.sampling = {is_tagged(node, "clamps_u", false), is_tagged(node, "clamps_v", false),
                    is_tagged(node, "sharp", false)};
  const Channels channels = channels_of(*bitmap, layers);
  if ((!channels[0] && !channels[1] && !channels[2]) || bitmap->depth == 0) return image;
  image.width = bitmap->width;
  image.height = bitmap->height;
  image.rgba.assign(std::size_t{image.width} * image.height * 4, 0);
  if (!channels[3])
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
  for (std::size_t c = 0; c < 4; ++c)
    if (channels[c]) fill_channel(image, c, *channels[c], {0, 0, image.width, image.height});
  return image;
}

}  // namespace septet::scene
