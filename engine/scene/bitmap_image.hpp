#pragma once
/// A bitmap node as an image (CONVENTIONS.md, "Bitmaps").

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "engine/scene/node.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::scene {

/// Empty where the node has no colour layer. The revision is left at zero.
TextureImage image_of_bitmap(const Node& node);
/// Of these layers for red, green and blue, an empty name the usual one's; a layer that is missing is 0.
TextureImage image_of_layers(const Node& node, const std::array<std::string_view, 3>& layers);

/// Renews the image's pixels of `tiles` tiles of a layer; returns the rectangle that holds them, empty if the layer is not
/// drawn. Nothing where the image is not of the bitmap's size.
std::optional<PixelRect> renew_tiles(TextureImage& image, const Node& bitmap, PartId layer, std::uint32_t first_tile,
                                     std::uint32_t tiles);

}  // namespace septet::scene
