#include "engine/render/passes/device_texture.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "engine/core/parallel_for.hpp"

namespace septet::render {
namespace {

using Code = std::array<std::uint8_t, 256>;

/// Table from 8-bit codes to the square root of linear light: the shader decodes it by a square, whereas decoding sRGB
/// texels costs a software rasteriser more than all other shading.
Code square_root_code(bool srgb) {
  Code code;
  for (std::size_t i = 0; i < code.size(); ++i)
    code[i] = static_cast<std::uint8_t>(std::lround(255.0 * std::sqrt(linear_of_code(i, srgb))));
  return code;
}

/// The same for a scene's images, of which linear ones, such as those of normals, keep their codes.
Code device_code(bool srgb) {
  if (srgb) return square_root_code(true);
  Code same;
  for (std::size_t i = 0; i < same.size(); ++i) same[i] = static_cast<std::uint8_t>(i);
  return same;
}

void encode(std::span<std::uint8_t> rgba, const Code& code) {
  for (std::size_t i = 0; i < rgba.size(); i += 4)
    for (std::size_t c = i; c < i + 3; ++c) rgba[c] = code[rgba[c]];
}

/// By image.
std::vector<Alpha> alphas_of(const scene::ResolvedScene& scene) {
  std::vector<bool> cuts(scene.images.size()), blends(scene.images.size());
  for (const scene::SurfaceMaterial& material : scene.materials)
    if (const auto image = static_cast<std::size_t>(material.base_color_image);
        material.base_color_image >= 0 && image < cuts.size())
      (is_blended(material) ? blends : cuts)[image] = true;
  std::vector<Alpha> alphas(cuts.size(), Alpha::cuts);
  for (std::size_t i = 0; i < alphas.size(); ++i)
    if (blends[i] && !cuts[i]) alphas[i] = Alpha::blends;
  return alphas;
}

}  // namespace

std::vector<MipLevel> texture_levels(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba,
                                     bool srgb) {
  std::vector<MipLevel> levels = mip_chain(width, height, rgba, srgb);
  const Code code = square_root_code(srgb);
  for (MipLevel& level : levels) encode(level.rgba, code);
  return levels;
}

vulkan::DeviceImage create_texture(vulkan::Upload& upload, std::span<const MipLevel> levels) {
  std::uint64_t bytes = 0;
  for (const MipLevel& level : levels) bytes += level.rgba.size();
  const vulkan::HostArena::Slice staged = upload.stage(bytes);
  std::vector<VkBufferImageCopy> regions;
  std::uint64_t at = 0;
  for (const MipLevel& level : levels) {
    std::memcpy(staged.data + at, level.rgba.data(), level.rgba.size());
    VkBufferImageCopy region{};
    region.bufferOffset = staged.offset + at;
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, static_cast<std::uint32_t>(regions.size()), 0, 1};
    region.imageExtent = {level.width, level.height, 1};
    regions.push_back(region);
    at += level.rgba.size();
  }
  vulkan::ImageDescription description;
  description.width = levels.front().width;
  description.height = levels.front().height;
  description.format = VK_FORMAT_R8G8B8A8_UNORM;
  description.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  description.mip_levels = static_cast<std::uint32_t>(levels.size());
  vulkan::DeviceImage image = create_image(upload.memory(), description);
  upload.add([image, source = staged.buffer, regions = std::move(regions)](VkCommandBuffer commands) {
    vulkan::ImageBarrier barrier{&image, VK_NULL_HANDLE, Access::none, Access::transfer_destination, true};
    vulkan::record_barriers(commands, {&barrier, 1});
    vkCmdCopyBufferToImage(commands, source, image.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                           static_cast<std::uint32_t>(regions.size()), regions.data());
    barrier = {&image, VK_NULL_HANDLE, Access::transfer_destination, Access::sampled, false};
    vulkan::record_barriers(commands, {&barrier, 1});
  });
  return image;
}

void upload_textures(std::vector<DeviceTexture>& textures, const scene::ResolvedScene& scene, vulkan::Upload& upload) {
  const std::vector<scene::TextureImage>& images = scene.images;
  const std::vector<Alpha> alphas = alphas_of(scene);
  const std::uint32_t largest = upload.device().properties.limits.maxImageDimension2D;
  while (textures.size() > images.size()) {
    destroy_image(upload.memory(), textures.back().image);
    textures.pop_back();
  }
  textures.resize(images.size());
  std::vector<std::size_t> changed;
  for (std::size_t i = 0; i < images.size(); ++i)
    if (!textures[i].image.image || textures[i].revision != images[i].revision ||
        (textures[i].holes && textures[i].alpha != alphas[i]))
      changed.push_back(i);
  std::vector<std::vector<MipLevel>> levels(changed.size());
  parallel_for(changed.size(), [&](std::size_t i) {
    const scene::TextureImage& image = images[changed[i]];
    const bool holds = image.width > 0 && image.height > 0 && image.width <= largest && image.height <= largest &&
                       image.rgba.size() == std::size_t{4} * image.width * image.height;
    if (holds) levels[i] = mip_chain(image.width, image.height, image.rgba, image.srgb, alphas[changed[i]]);
  });
  for (std::size_t i = 0; i < changed.size(); ++i) {
    DeviceTexture& texture = textures[changed[i]];
    destroy_image(upload.memory(), texture.image);
    const scene::TextureImage& source = images[changed[i]];
    texture = {source.revision, false, alphas[changed[i]], source.srgb, source.sampling, {}, {}};
    if (levels[i].empty()) continue;
    texture.holes = has_holes(images[changed[i]].rgba);
    if (!texture.holes) {
      texture.levels = levels[i];
      texture.levels.front().rgba = {};
    }
    const Code code = device_code(images[changed[i]].srgb);
    for (MipLevel& level : levels[i]) encode(level.rgba, code);
    texture.image = create_texture(upload, levels[i]);
  }
}

bool renew_texture(DeviceTexture& texture, const scene::TextureImage& image, const scene::PixelRect& pixels,
                   vulkan::Upload& upload) {
  if (texture.levels.empty() || texture.levels.front().width != image.width ||
      texture.levels.front().height != image.height || image.rgba.size() != std::size_t{4} * image.width * image.height)
    return false;
  for (std::uint32_t y = pixels.y; y < pixels.y + pixels.height; ++y)
    if (has_holes(std::span(image.rgba).subspan((std::size_t{y} * image.width + pixels.x) * 4, pixels.width * 4)))
      return false;
  const std::vector<MipRect> rects =
      renew_mips(texture.levels, image.rgba, {pixels.x, pixels.y, pixels.width, pixels.height}, image.srgb);
  std::uint64_t bytes = 0;
  for (const MipRect& rect : rects) bytes += std::uint64_t{4} * rect.width * rect.height;
  const vulkan::HostArena::Slice staged = upload.stage(bytes);
  const Code code = device_code(image.srgb);
  std::vector<VkBufferImageCopy> regions;
  std::uint64_t at = 0;
  for (std::size_t i = 0; i < rects.size(); ++i) {
    const MipRect& rect = rects[i];
    const std::vector<std::uint8_t>& level = i == 0 ? image.rgba : texture.levels[i].rgba;
    auto* const target = reinterpret_cast<std::uint8_t*>(staged.data + at);
    const std::size_t row_bytes = std::size_t{4} * rect.width;
    for (std::uint32_t y = 0; y < rect.height; ++y)
      std::memcpy(target + y * row_bytes, &level[(std::size_t{rect.y + y} * texture.levels[i].width + rect.x) * 4],
                  row_bytes);
    encode({target, row_bytes * rect.height}, code);
    VkBufferImageCopy region{};
    region.bufferOffset = staged.offset + at;
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, static_cast<std::uint32_t>(i), 0, 1};
    region.imageOffset = {static_cast<std::int32_t>(rect.x), static_cast<std::int32_t>(rect.y), 0};
    region.imageExtent = {rect.width, rect.height, 1};
    regions.push_back(region);
    at += row_bytes * rect.height;
  }
  texture.revision = image.revision;
  upload.add([image = texture.image, source = staged.buffer, regions = std::move(regions)](VkCommandBuffer commands) {
    vulkan::ImageBarrier barrier{&image, VK_NULL_HANDLE, Access::sampled, Access::transfer_destination, false};
    vulkan::record_barriers(commands, {&barrier, 1});
    vkCmdCopyBufferToImage(commands, source, image.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                           static_cast<std::uint32_t>(regions.size()), regions.data());
    barrier = {&image, VK_NULL_HANDLE, Access::transfer_destination, Access::sampled, false};
    vulkan::record_barriers(commands, {&barrier, 1});
  });
  return true;
}

}  // namespace septet::render
