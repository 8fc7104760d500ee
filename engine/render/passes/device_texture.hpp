#pragma once
/// Images of a scene on the device, with mip levels: of sRGB images the square root of linear light, others as they are.

#include <cstdint>
#include <span>
#include <vector>

#include "engine/render/mip_chain.hpp"
#include "engine/render/vulkan/commands.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::render {

struct DeviceTexture {
  std::uint64_t revision = 0;
  bool holes = false;
  Alpha alpha = Alpha::cuts;  ///< What the levels were made for.
  bool square_roots = true;   ///< Holds square roots of linear light.
  scene::ImageSampling sampling{};
  vulkan::DeviceImage image;
  /// Levels of an image without holes, the full one without its pixels, so that a part of it can be renewed.
  std::vector<MipLevel> levels;
};

/// All levels of a texture, as the square root of linear light.
std::vector<MipLevel> texture_levels(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba,
                                     bool srgb);

/// Creates a sampled image; the upload fills it with these levels.
vulkan::DeviceImage create_texture(vulkan::Upload& upload, std::span<const MipLevel> levels);

/// True for a material whose alpha is its opacity, instead of cutting holes.
inline bool is_blended(const scene::SurfaceMaterial& material) { return material.opacity < scene::opaque_from; }

/// Makes anew those textures whose images have another revision, and those with holes that materials now read
/// otherwise: alpha cuts where any opaque material has the image as its base colour.
void upload_textures(std::vector<DeviceTexture>& textures, const scene::ResolvedScene& scene, vulkan::Upload& upload);
/// Brings a rectangle of a texture up to its image; false where it has to be made anew, since it has holes.
bool renew_texture(DeviceTexture& texture, const scene::TextureImage& image, const scene::PixelRect& pixels,
                   vulkan::Upload& upload);

}  // namespace septet::render
