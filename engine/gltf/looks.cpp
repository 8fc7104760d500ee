#include "engine/gltf/looks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include "engine/core/printable.hpp"
#include "engine/image/jpeg.hpp"
#include "engine/image/png.hpp"

namespace septet::gltf {
namespace {

using image::Image;

const Json& member(const Json& object, const char* name) {
  static const Json none = Json::object();
  if (!object.is_object()) return none;
  const auto found = object.find(name);
  return found != object.end() && found->is_object() ? *found : none;
}

const Json& extension(const Json& object, const char* name) { return member(member(object, "extensions"), name); }

/// A colour's factor, each number from 0 to `most`.
glm::vec3 factor_of(const Json& object, const char* name, const glm::vec3& otherwise, float most) {
  const Json& list = list_of(object, name);
  if (list.size() < 3) return otherwise;
  glm::vec3 factor = otherwise;
  for (int i = 0; i < 3; ++i)
    if (list[static_cast<std::size_t>(i)].is_number())
      factor[i] = static_cast<float>(
          std::clamp(list[static_cast<std::size_t>(i)].get<double>(), 0.0, static_cast<double>(most)));
  return factor;
}

float share(double value) { return static_cast<float>(std::clamp(value, 0.0, 1.0)); }

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

/// Ways in which a picture goes on beyond its edges (3.8.4.5); any other repeats.
constexpr std::int64_t clamped = 33071, mirrored = 33648;

struct Wrapping {
  std::int64_t u = 0, v = 0;
};

std::uint32_t big_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

class Looks {
 public:
  Looks(const Container& container, Model& model) : container_(container), model_(model) {}

  Expected<Look> look(const Json& material, std::size_t index) {
    Look look;
    look.name = printable(text_in(material, "name"), 80);
    if (look.name.empty()) look.name = fmt::format("material {}", index);
    const Json& metallic_roughness = member(material, "pbrMetallicRoughness");
    look.base_color = factor_of(metallic_roughness, "baseColorFactor", glm::vec3(1.0f), 1.0f);
    const Json& factors = list_of(metallic_roughness, "baseColorFactor");
    const std::string mode = text_in(material, "alphaMode");
    if (mode == "BLEND" && factors.size() > 3 && factors[3].is_number()) look.opacity = share(factors[3].get<double>());
    const Json& through = extension(material, "KHR_materials_transmission");
    look.opacity *= 1.0f - 0.9f * share(number_in(through, "transmissionFactor", 0.0));
    look.metallic = share(number_in(metallic_roughness, "metallicFactor", 1.0));
    look.roughness = share(number_in(metallic_roughness, "roughnessFactor", 1.0));
    if (metallic_roughness.contains("metallicRoughnessTexture")) {
      auto picture = picture_of(member(metallic_roughness, "metallicRoughnessTexture"), look.name);
      if (!picture) return tl::unexpected(picture.error());
      const glm::vec3 mean = *picture ? mean_of(**picture) : glm::vec3(0.0f, 0.6f, 0.0f);
      look.roughness *= mean.g;
      look.metallic *= mean.b;
    }
    look.two_sided = is_true_in(material, "doubleSided");
    const double strength = number_in(extension(material, "KHR_materials_emissive_strength"), "emissiveStrength", 1.0);
    constexpr double most_strength = 100.0;
    look.emission = factor_of(material, "emissiveFactor", glm::vec3(0.0f), 1.0f) *
                    static_cast<float>(std::clamp(strength, 0.0, most_strength));
    if (material.is_object() && material.contains("emissiveTexture") && look.emission != glm::vec3(0.0f)) {
      look.emission = glm::vec3(0.0f);
      model_.left_out.push_back(fmt::format("material \"{}\" shines by a texture, which is not read", look.name));
    }
    if (metallic_roughness.contains("baseColorTexture")) {
      auto picture = picture_of(member(metallic_roughness, "baseColorTexture"), look.name);
      if (!picture) return tl::unexpected(picture.error());
      const Json& texture = metallic_roughness["baseColorTexture"];
      if (*picture) {
        const Wrapping wrapping = wrapping_of(texture, look.name);
        look.picture = drawn(std::move(**picture), *source_of(texture), mode, wrapping);
        look.mapping = mapping_of(texture);
        look.mapping.share = {wrapping.u == mirrored ? 0.5 : 1.0, wrapping.v == mirrored ? 0.5 : 1.0};
        look.clamps = wrapping.u == clamped || wrapping.v == clamped;
      }
    }
    return look;
  }

 private:
  static PictureMapping mapping_of(const Json& texture) {
    const Json& transform = extension(texture, "KHR_texture_transform");
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

  /// A texture's sampler (3.8.4); what is unknown repeats. Pixels that should stay sharp are reported.
  Wrapping wrapping_of(const Json& texture, const std::string& material) {
    const Json& textures = list_of(*container_.json, "textures");
    const Json& samplers = list_of(*container_.json, "samplers");
    const std::int64_t index = index_in(textures[static_cast<std::size_t>(index_in(texture, "index"))], "sampler");
    if (index < 0 || static_cast<std::uint64_t>(index) >= samplers.size()) return {};
    const Json& sampler = samplers[static_cast<std::size_t>(index)];
    constexpr std::int64_t nearest = 9728;
    if (index_in(sampler, "magFilter") == nearest)
      model_.left_out.push_back(
          fmt::format("material \"{}\" asks for sharp pixels (magFilter NEAREST), which are smoothed", material));
    return {index_in(sampler, "wrapS"), index_in(sampler, "wrapT")};
  }

  /// Index of a texture's image.
  std::optional<std::int64_t> source_of(const Json& texture) const {
    const std::int64_t index = index_in(texture, "index");
    const Json& textures = list_of(*container_.json, "textures");
    if (index < 0 || static_cast<std::uint64_t>(index) >= textures.size()) return std::nullopt;
    const std::int64_t source = index_in(textures[static_cast<std::size_t>(index)], "source");
    if (source < 0 || static_cast<std::uint64_t>(source) >= list_of(*container_.json, "images").size())
      return std::nullopt;
    return source;
  }

  /// Empty where the picture is of an unsupported kind, which is then reported.
  Expected<std::optional<Image>> picture_of(const Json& texture, const std::string& material) {
    const auto source = source_of(texture);
    if (!source)
      return failure(fmt::format("material \"{}\" has a texture without an image", material), container_.where,
                     export_anew);
    const std::string where = fmt::format("{}, image {}", container_.where, *source);
    const Json& json = list_of(*container_.json, "images")[static_cast<std::size_t>(*source)];
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
      model_.left_out.push_back(
          fmt::format("image {} is neither PNG nor JPEG: material \"{}\" has its plain colour", *source, material));
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

  static glm::vec3 mean_of(const Image& picture) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i + 3 < picture.rgba.size(); i += 4)
      sum += glm::dvec3(picture.rgba[i], picture.rgba[i + 1], picture.rgba[i + 2]);
    const std::size_t pixels = std::max<std::size_t>(picture.rgba.size() / 4, 1);
    return glm::vec3(sum / (255.0 * static_cast<double>(pixels)));
  }

  /// The picture's index among the model's; alpha cuts out only where the material asks for it.
  std::int32_t drawn(Image picture, std::int64_t source, const std::string& mode, const Wrapping& wrapping) {
    const bool cut = mode == "MASK" || mode == "BLEND";
    const auto [known, is_new] = drawn_.try_emplace({source, cut, wrapping.u == mirrored, wrapping.v == mirrored},
                                                    static_cast<std::int32_t>(model_.pictures.size()));
    if (!is_new) return known->second;
    while (std::max(picture.width, picture.height) > drawn_picture_px) picture = halved(picture);
    picture = with_mirror_image(picture, wrapping.u == mirrored, wrapping.v == mirrored);
    while (std::max(picture.width, picture.height) > drawn_picture_px) picture = halved(picture);
    if (!cut)
      for (std::size_t i = 3; i < picture.rgba.size(); i += 4) picture.rgba[i] = 255;
    model_.pictures.push_back(std::move(picture));
    return known->second;
  }

  const Container& container_;
  Model& model_;
  std::size_t pixels_ = 0;
  /// By image, cut out or not, mirrored along u and along v.
  std::map<std::tuple<std::int64_t, bool, bool, bool>, std::int32_t> drawn_;
};

}  // namespace

Expected<void> read_looks(const Container& container, Model& model) {
  const Json& materials = list_of(*container.json, "materials");
  if (materials.size() > most_materials)
    return failure(fmt::format("it has {} materials, more than {}", materials.size(), most_materials), container.where,
                   "join those that look alike");
  Looks looks(container, model);
  for (std::size_t i = 0; i < materials.size(); ++i) {
    auto look = looks.look(materials[i], i);
    if (!look) return tl::unexpected(look.error());
    model.looks.push_back(std::move(*look));
  }
  model.looks.push_back({.name = "plain", .base_color = glm::vec3(0.8f), .roughness = 0.7f, .metallic = 0.0f});
  return {};
}

}  // namespace septet::gltf
