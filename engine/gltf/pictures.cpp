#include "engine/gltf/pictures.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include "engine/image/jpeg.hpp"
#include "engine/image/png.hpp"

namespace septet::gltf {
namespace {

using image::Image;

/// Half the size, each pixel the mean of four; the last row and column of odd sizes are dropped.
Image halved(const Image& picture) {
  Image half(std::max(picture.width / 2, 1u), std::max(picture.height / 2, 1u));
  for (std::uint32_t y = 0; y < half.height; ++y)
    for (std::uint32_t x = 0; x < half.width; ++x)
      for (std::size_t c = 0; c < 4; ++c) {
        std::uint32_t sum = 2;
        for (const std::uint32_t dy : {0u, 1u})
          for (const std::uint32_t dx : {0u, 1u}) {
            const std::size_t column = std::min(2 * x + dx, picture.width - 1),
                              row = std::min(2 * y + dy, picture.height - 1);
            sum += picture.rgba[(row * picture.width + column) * 4 + c];
          }
        half.rgba[(std::size_t{y} * half.width + x) * 4 + c] = static_cast<std::uint8_t>(sum / 4);
      }
  return half;
}

/// The picture followed by its mirror image on the right, below, or both.
Image with_mirror_image(const Image& picture, bool right, bool below) {
  if (!right && !below) return picture;
  Image whole(right ? 2 * picture.width : picture.width, below ? 2 * picture.height : picture.height);
  for (std::uint32_t y = 0; y < whole.height; ++y)
    for (std::uint32_t x = 0; x < whole.width; ++x)
      whole.set(x, y,
                picture.at(x < picture.width ? x : whole.width - 1 - x, y < picture.height ? y : whole.height - 1 - y));
  return whole;
}

std::uint32_t big_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

PictureMapping picture_transform(const Json& texture) {
  const Json& transform = extension_in(texture, "KHR_texture_transform");
  const std::int64_t set = index_in(transform, "texCoord", index_in(texture, "texCoord", 0));
  constexpr double furthest = 1e6;
  const auto pair = [&](const char* name, const glm::dvec2& otherwise) {
    const Json& list = list_of(transform, name);
    if (list.size() != 2 || !list[0].is_number() || !list[1].is_number()) return otherwise;
    return glm::clamp(glm::dvec2(list[0].get<double>(), list[1].get<double>()), -furthest, furthest);
  };
  return {.uv_set = static_cast<std::uint32_t>(std::clamp<std::int64_t>(set, 0, 999)),
          .scale = pair("scale", glm::dvec2(1.0)),
          .offset = pair("offset", glm::dvec2(0.0)),
          .rotation_rad = number_in(transform, "rotation", 0.0)};
}

}  // namespace

std::optional<std::int64_t> Pictures::image_of(const Json& texture) const {
  const std::int64_t index = index_in(texture, "index");
  const Json& textures = list_of(*container_.json, "textures");
  if (index < 0 || static_cast<std::uint64_t>(index) >= textures.size()) return std::nullopt;
  const std::int64_t source = index_in(textures[static_cast<std::size_t>(index)], "source");
  if (source < 0 || static_cast<std::uint64_t>(source) >= list_of(*container_.json, "images").size())
    return std::nullopt;
  return source;
}

const Json& Pictures::sampler_of(const Json& texture) const {
  static const Json none = Json::object();
  const Json& textures = list_of(*container_.json, "textures");
  const Json& samplers = list_of(*container_.json, "samplers");
  const std::int64_t texture_index = index_in(texture, "index");
  if (texture_index < 0 || static_cast<std::uint64_t>(texture_index) >= textures.size()) return none;
  const std::int64_t index = index_in(textures[static_cast<std::size_t>(texture_index)], "sampler");
  if (index < 0 || static_cast<std::uint64_t>(index) >= samplers.size()) return none;
  return samplers[static_cast<std::size_t>(index)];
}

Wrapping Pictures::wrapping_of(const Json& texture) const {
  const Json& sampler = sampler_of(texture);
  const auto known = [&](const char* name) {
    const std::int64_t way = index_in(sampler, name);
    return way == clamped || way == mirrored ? way : 0;
  };
  return {known("wrapS"), known("wrapT")};
}

PictureMapping Pictures::mapping_of(const Json& texture) const {
  const Wrapping wrapping = wrapping_of(texture);
  PictureMapping mapping = picture_transform(texture);
  mapping.share = {wrapping.u == mirrored ? 0.5 : 1.0, wrapping.v == mirrored ? 0.5 : 1.0};
  return mapping;
}

bool Pictures::is_sharp(const Json& texture) const {
  constexpr std::int64_t nearest = 9728;
  return index_in(sampler_of(texture), "magFilter") == nearest;
}

Expected<std::optional<Image>> Pictures::read(std::int64_t image, const std::string& instead) {
  const std::string where = fmt::format("{}, image {}", container_.where, image);
  const Json& json = list_of(*container_.json, "images")[static_cast<std::size_t>(image)];
  std::string decoded;
  std::string_view bytes;
  if (json.is_object() && json.contains("uri")) {
    auto read = bytes_of_uri(text_in(json, "uri"), where);
    if (!read) return tl::unexpected(read.error());
    decoded = std::move(*read);
    bytes = decoded;
  } else {
    auto read = view_bytes(container_, index_in(json, "bufferView"), where);
    if (!read) return tl::unexpected(read.error());
    bytes = *read;
  }
  const auto file = std::as_bytes(std::span(bytes.data(), bytes.size()));
  const bool is_jpeg = image::begins_as_jpeg(file);
  if (!is_jpeg && (bytes.size() < 24 || !bytes.starts_with("\x89PNG"))) {
    model_.left_out.push_back(fmt::format("image {} is neither PNG nor JPEG: {}", image, instead));
    return std::optional<Image>();
  }
  if (!is_jpeg) {
    const std::uint32_t width = big_endian(bytes, 16), height = big_endian(bytes, 20);
    if (width > largest_picture_px || height > largest_picture_px)
      return failure(fmt::format("it is of {} × {} pixels, more than {} a side", width, height, largest_picture_px),
                     where, "make it smaller");
  }
  auto picture = is_jpeg ? image::decode_jpeg(file, where, largest_picture_px) : image::decode_png(file, where);
  if (!picture) return tl::unexpected(picture.error());
  pixels_ += std::size_t{picture->width} * picture->height;
  if (pixels_ > 16 * std::size_t{largest_picture_px} * largest_picture_px / 4)
    return failure("its images hold too many pixels", container_.where, "make them smaller");
  return std::optional<Image>(std::move(*picture));
}

std::optional<std::int32_t> Pictures::find(const PictureKey& key) const {
  const auto known = kept_.find(key);
  return known == kept_.end() ? std::nullopt : std::optional(known->second);
}

std::int32_t Pictures::keep(const PictureKey& key, Image picture) {
  const bool right = key.wrapping.u == mirrored, below = key.wrapping.v == mirrored;
  while (std::max(picture.width, picture.height) > drawn_picture_px) picture = halved(picture);
  picture = with_mirror_image(picture, right, below);
  while (std::max(picture.width, picture.height) > drawn_picture_px) picture = halved(picture);
  using Use = PictureKey::Use;
  if (key.use != Use::cut_out && key.use != Use::blended)
    for (std::size_t i = 3; i < picture.rgba.size(); i += 4) picture.rgba[i] = 255;
  const auto index = static_cast<std::int32_t>(model_.pictures.size());
  const bool is_linear = key.use == Use::properties || key.use == Use::normal;
  model_.pictures.push_back(
      {std::move(picture), is_linear, key.wrapping.u == clamped, key.wrapping.v == clamped, key.is_sharp});
  kept_.emplace(key, index);
  return index;
}

}  // namespace septet::gltf
