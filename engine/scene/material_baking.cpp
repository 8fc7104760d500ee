#include "engine/scene/material_baking.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "engine/core/parallel_for.hpp"
#include "engine/image/srgb.hpp"
#include "engine/scene/bitmap_image.hpp"
#include "engine/scene/image_reading.hpp"
#include "engine/scene/material_evaluation.hpp"
#include "engine/scene/material_lobes.hpp"

namespace septet::scene {
namespace {

/// Renderers take a surface from opaque_from on for one with holes or without, by alpha's half.
constexpr float most_blended_opacity = 0.998f;

struct BakedTexel {
  SurfaceNumbers numbers;
  float alpha = 1.0f;
};

/// Bitmaps as a tree's textures read them.
class ReadPictures {
 public:
  ReadPictures(const MaterialData& material, const std::function<const Node*(NodeId)>& bitmap) {
    for (const auto& [id, fragment] : material.fragments) {
      const auto* texture = std::get_if<TextureFragment>(&fragment);
      const Node* node = texture ? bitmap(texture->bitmap) : nullptr;
      if (!node || pictures_.size() >= most_read_pictures) continue;
      const auto [entry, added] = pictures_.try_emplace(key_of(*texture));
      if (added)
        entry->second = image_of_layers(*node, {texture->layer_red, texture->layer_green, texture->layer_blue});
    }
  }
  glm::vec4 read(const TextureFragment& texture, const glm::vec2& at) const {
    const auto found = pictures_.find(key_of(texture));
    return found == pictures_.end() ? glm::vec4(0.0f, 0.0f, 0.0f, 1.0f)
                                    : read_image(found->second, at, texture.filtered);
  }
  std::uint32_t largest_side() const {
    std::uint32_t side = 0;
    for (const auto& [key, picture] : pictures_) side = std::max({side, picture.width, picture.height});
    return side;
  }

 private:
  using Key = std::tuple<NodeId, std::string, std::string, std::string>;
  static Key key_of(const TextureFragment& texture) {
    return {texture.bitmap, texture.layer_red, texture.layer_green, texture.layer_blue};
  }
  std::map<Key, TextureImage> pictures_;
};

std::uint32_t side_of(const MaterialData& material, const ReadPictures& pictures) {
  std::uint32_t side = std::clamp(pictures.largest_side(), baked_side, most_baked_side);
  while (side > 8 && std::uint64_t{side} * side * material.fragments.size() > most_evaluations) side /= 2;
  return side;
}

/// Codes of sRGB without a power for each: the code at each of 4096 steps of light, and the light at which each code begins.
struct SrgbCodes {
  std::array<std::uint8_t, 4097> at_step{};
  std::array<float, 257> begins{};

  SrgbCodes() {
    for (std::size_t code = 1; code < 256; ++code)
      begins[code] = image::light_of_srgb((static_cast<float>(code) - 0.5f) / 255.0f);
    begins[256] = 2.0f;
    std::size_t code = 0;
    for (std::size_t step = 0; step < at_step.size(); ++step) {
      while (static_cast<float>(step) / 4096.0f >= begins[code + 1]) ++code;
      at_step[step] = static_cast<std::uint8_t>(code);
    }
  }
  std::uint8_t of(float light) const {
    std::size_t code = at_step[static_cast<std::size_t>(light * 4096.0f)];
    while (light >= begins[code + 1]) ++code;
    return static_cast<std::uint8_t>(code);
  }
};

std::uint8_t code_of(float share, bool srgb) {
  static const SrgbCodes srgb_codes;  // Constants.
  const float unit = std::clamp(share, 0.0f, 1.0f);
  return srgb ? srgb_codes.of(unit) : static_cast<std::uint8_t>(std::lround(255.0f * unit));
}

/// Of `color` (red, green, blue, alpha; from 0 to 1) of each texel.
template <class Color>
TextureImage image_of(const std::vector<BakedTexel>& texels, std::uint32_t side, bool srgb, const Color& color) {
  TextureImage image{.width = side, .height = side, .srgb = srgb, .rgba = {}};
  image.rgba.resize(texels.size() * 4);
  parallel_for(side, [&](std::size_t row) {
    for (std::size_t i = row * side; i < (row + 1) * side; ++i) {
      const glm::vec4 value = color(texels[i]);
      for (int c = 0; c < 3; ++c) image.rgba[4 * i + static_cast<std::size_t>(c)] = code_of(value[c], srgb);
      image.rgba[4 * i + 3] = code_of(value.a, false);
    }
  });
  return image;
}

/// value/most, and 0 where that is 0.
glm::vec3 share_of(const glm::vec3& value, const glm::vec3& most) {
  const auto one = [](float part, float whole) { return whole > 0.0f ? part / whole : 0.0f; };
  return {one(value.r, most.r), one(value.g, most.g), one(value.b, most.b)};
}

/// True where `quantity` has more than one value.
template <class Quantity>
bool varies(const std::vector<BakedTexel>& texels, const Quantity& quantity) {
  return std::ranges::any_of(texels, [&](const BakedTexel& t) { return quantity(t) != quantity(texels.front()); });
}

BakedSurface pictures_of(const std::vector<BakedTexel>& texels, std::uint32_t side) {
  BakedSurface baked;
  SurfaceNumbers most = texels.front().numbers;
  for (const BakedTexel& texel : texels) {
    most.base_color = glm::max(most.base_color, texel.numbers.base_color);
    most.emission = glm::max(most.emission, texel.numbers.emission);
    most.opacity = std::max(most.opacity, texel.numbers.opacity);
    most.roughness = std::max(most.roughness, texel.numbers.roughness);
    most.metallic = std::max(most.metallic, texel.numbers.metallic);
  }
  const bool blended = std::ranges::any_of(texels, [](const BakedTexel& t) { return t.numbers.opacity < opaque_from; });
  if (blended) most.opacity = std::min(most.opacity, most_blended_opacity);
  baked.numbers = most;

  const auto alpha = [&](const BakedTexel& t) {
    return t.alpha * (most.opacity > 0.0f ? std::min(1.0f, t.numbers.opacity / most.opacity) : 1.0f);
  };
  if (varies(texels, [](const BakedTexel& t) { return t.numbers.base_color; }) || varies(texels, alpha) ||
      alpha(texels.front()) < 1.0f)
    baked.base_color = image_of(texels, side, true, [&](const BakedTexel& t) {
      return glm::vec4(share_of(t.numbers.base_color, most.base_color), alpha(t));
    });
  if (varies(texels, [](const BakedTexel& t) { return t.numbers.emission; }))
    baked.emission = image_of(texels, side, true, [&](const BakedTexel& t) {
      return glm::vec4(share_of(t.numbers.emission, most.emission), 1.0f);
    });
  const auto finish = [](const BakedTexel& t) { return glm::vec2(t.numbers.roughness, t.numbers.metallic); };
  if (varies(texels, finish))
    baked.properties = image_of(texels, side, false, [&](const BakedTexel& t) {
      return glm::vec4(share_of({1.0f, t.numbers.roughness, t.numbers.metallic}, {1.0f, most.roughness, most.metallic}),
                       1.0f);
    });
  return baked;
}

}  // namespace

bool is_to_be_baked(const Node& material) {
  const auto* data = std::get_if<MaterialData>(&material.data);
  return data && !evaluate_lobes(*data).exact;
}

std::set<NodeId> bitmaps_of(const Node& material) {
  std::set<NodeId> bitmaps;
  if (const auto* data = std::get_if<MaterialData>(&material.data))
    for (const auto& [id, fragment] : data->fragments)
      if (const auto* texture = std::get_if<TextureFragment>(&fragment)) bitmaps.insert(texture->bitmap);
  return bitmaps;
}

BakedSurface bake_material(const Node& material, const std::function<const Node*(NodeId)>& bitmap) {
  const auto* data = std::get_if<MaterialData>(&material.data);
  if (!data) return {};
  const ReadPictures pictures(*data, bitmap);
  const FinishTags tags = finish_tags(material);
  const std::uint32_t side = side_of(*data, pictures);
  std::vector<BakedTexel> texels(std::size_t{side} * side);
  constexpr std::size_t band = 32;  // Rows at once: what is the same all over is evaluated once in each.
  parallel_for((side + band - 1) / band, [&](std::size_t n) {
    LobesAtPlaces lobes_at(*data);
    SurfacePlace place;
    place.texture = [&](const TextureFragment& texture, const glm::vec2& at) { return pictures.read(texture, at); };
    for (std::size_t i = n * band * side; i < std::min<std::size_t>((n + 1) * band, side) * side; ++i) {
      place.uv = (glm::vec2(i % side, i / side) + 0.5f) / static_cast<float>(side);
      const Lobes lobes = lobes_at.at(place);
      texels[i] = {surface_numbers(lobes, tags), lobes.alpha};
    }
  });
  return pictures_of(texels, side);
}

}  // namespace septet::scene
