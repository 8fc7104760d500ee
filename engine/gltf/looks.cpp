#include "engine/gltf/looks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/core/printable.hpp"
#include "engine/gltf/alpha_pictures.hpp"
#include "engine/gltf/linear_pictures.hpp"
#include "engine/gltf/pictures.hpp"

namespace septet::gltf {
namespace {

using image::Image;
using Use = PictureKey::Use;

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

class Looks {
 public:
  Looks(const Container& container, Model& model) : container_(container), model_(model), pictures_(container, model) {}

  Expected<Look> look(const Json& material, std::size_t index) {
    Look look;
    look.name = printable(text_in(material, "name"), 80);
    if (look.name.empty()) look.name = fmt::format("material {}", index);
    const Json& metallic_roughness = member_of(material, "pbrMetallicRoughness");
    look.base_color = factor_of(metallic_roughness, "baseColorFactor", glm::vec3(1.0f), 1.0f);
    const Json& factors = list_of(metallic_roughness, "baseColorFactor");
    const std::string mode = text_in(material, "alphaMode");
    const float alpha = factors.size() > 3 && factors[3].is_number() ? share(factors[3].get<double>()) : 1.0f;
    if (mode == "BLEND") look.opacity = alpha;
    const Json& through = extension_in(material, "KHR_materials_transmission");
    look.opacity *= 1.0f - 0.9f * share(number_in(through, "transmissionFactor", 0.0));
    look.metallic = share(number_in(metallic_roughness, "metallicFactor", 1.0));
    look.roughness = share(number_in(metallic_roughness, "roughnessFactor", 1.0));
    look.two_sided = is_true_in(material, "doubleSided");
    const double strength =
        number_in(extension_in(material, "KHR_materials_emissive_strength"), "emissiveStrength", 1.0);
    constexpr double most_strength = 100.0;
    look.emission = factor_of(material, "emissiveFactor", glm::vec3(0.0f), 1.0f) *
                    static_cast<float>(std::clamp(strength, 0.0, most_strength));
    const bool is_unlit = member_of(material, "extensions").contains("KHR_materials_unlit");
    look.is_unlit = is_unlit;
    mapping_.reset();
    second_mapping_.reset();
    const float cutoff = share(number_in(material, "alphaCutoff", 0.5)) / std::max(alpha, 0.01f);
    if (auto added = add_base_color(metallic_roughness, mode, cutoff, look); !added)
      return tl::unexpected(added.error());
    if (is_unlit) {
      if (auto shining = shine(metallic_roughness, look); !shining) return tl::unexpected(shining.error());
    } else if (auto added = add_emission(material, look); !added) {
      return tl::unexpected(added.error());
    }
    if (!is_unlit) {
      if (auto added = add_properties(material, look); !added) return tl::unexpected(added.error());
      if (auto added = add_normal(material, look); !added) return tl::unexpected(added.error());
    }
    look.mapping = mapping_.value_or(PictureMapping{});
    look.second_mapping = second_mapping_.value_or(PictureMapping{});
    for (const std::int32_t shown :
         {look.picture, look.emission_picture, look.properties_picture, look.normal_picture}) {
      if (shown < 0) continue;
      look.ends_u |= model_.pictures[static_cast<std::size_t>(shown)].ends_u;
      look.ends_v |= model_.pictures[static_cast<std::size_t>(shown)].ends_v;
    }
    return look;
  }

 private:
  /// An image, and whether it lies by the second set of coordinates.
  struct Laid {
    std::int64_t image = -1;
    bool by_second = false;
  };

  /// By which of its triangles' two sets of coordinates a texture of a material lies: the first is that of the first
  /// texture, the second that of the first other one. Empty, and told: by neither.
  std::optional<bool> lies_by_second(const Json& texture, const Look& look, const char* what) {
    const PictureMapping mapping = pictures_.mapping_of(texture);
    if (!mapping_) mapping_ = mapping;
    if (*mapping_ == mapping) return false;
    if (!second_mapping_) second_mapping_ = mapping;
    if (*second_mapping_ == mapping) return true;
    model_.left_out.push_back(
        fmt::format("material \"{}\" lays its {} texture in a third way, which is not done: it is drawn without it",
                    look.name, what));
    return std::nullopt;
  }

  /// The image of a texture that is used; empty, and told, where it is not.
  std::optional<Laid> image_of(const Json& owner, const char* name, const Look& look, const char* what) {
    if (!owner.is_object() || !owner.contains(name)) return std::nullopt;
    const Json& texture = member_of(owner, name);
    const auto image = pictures_.image_of(texture);
    if (!image) {
      model_.left_out.push_back(
          fmt::format("material \"{}\" has {} {} texture without an image that is read: it is drawn without it",
                      look.name, what[0] == 'e' || what[0] == 'o' ? "an" : "a", what));
      return std::nullopt;
    }
    const auto by_second = lies_by_second(texture, look, what);
    return by_second ? std::optional(Laid{*image, *by_second}) : std::nullopt;
  }

  static void lay(const Laid& laid, std::uint32_t bit, std::int32_t picture, Look& look) {
    if (laid.by_second && picture >= 0) look.by_second_uv |= bit;
  }

  PictureKey key_of(const Json& texture, Use use, std::int64_t image) const {
    return {.use = use,
            .image = image,
            .wrapping = pictures_.wrapping_of(texture),
            .is_sharp = pictures_.is_sharp(texture)};
  }

  Expected<std::optional<Image>> read(std::int64_t image, const Look& look, const char* what) {
    return pictures_.read(image, fmt::format("material \"{}\" is drawn without its {} texture", look.name, what));
  }

  /// `cutoff`: alpha of the picture below which it is cut out.
  Expected<void> add_base_color(const Json& metallic_roughness, const std::string& mode, float cutoff, Look& look) {
    if (!metallic_roughness.contains("baseColorTexture")) return {};
    const Json& texture = member_of(metallic_roughness, "baseColorTexture");
    const auto image = pictures_.image_of(texture);
    if (!image)
      return failure(fmt::format("material \"{}\" has a texture without an image", look.name), container_.where,
                     export_anew);
    // Alpha counts only where the material asks for it.
    const bool blends = mode == "BLEND", cuts = mode == "MASK";
    PictureKey key = key_of(texture, cuts ? Use::cut_out : blends ? Use::blended : Use::base_color, *image);
    if (cuts) key.strength = cutoff;
    if (const auto known = pictures_.find(key)) {
      look.picture = *known;
    } else {
      auto picture = pictures_.read(*image, fmt::format("material \"{}\" has its plain colour", look.name));
      if (!picture) return tl::unexpected(picture.error());
      if (!*picture) return {};
      if (cuts) move_cutoff(**picture, cutoff);
      look.picture = pictures_.keep(key, std::move(**picture));
    }
    look.alpha_blends = blends && is_see_through(model_.pictures[static_cast<std::size_t>(look.picture)]);
    lies_by_second(texture, look, "base colour");
    return {};
  }

  /// KHR_materials_unlit: the base colour is what is seen, whatever the light.
  Expected<void> shine(const Json& metallic_roughness, Look& look) {
    look.emission = std::exchange(look.base_color, glm::vec3(0.0f));
    look.roughness = 1.0f;
    look.metallic = 0.0f;
    if (look.picture < 0) return {};
    const Json& texture = member_of(metallic_roughness, "baseColorTexture");
    const auto image = pictures_.image_of(texture);
    return image ? add(key_of(texture, Use::emission, *image), look, "emission", look.emission_picture, [](Image&) {})
                 : Expected<void>{};
  }

  /// Emission by a texture, times the factor (3.9.3); a picture of the base colour alone does not colour it.
  Expected<void> add_emission(const Json& material, Look& look) {
    if (look.emission == glm::vec3(0.0f)) return {};
    const auto image = image_of(material, "emissiveTexture", look, "emission");
    if (!image) return {};
    const PictureKey key = key_of(member_of(material, "emissiveTexture"), Use::emission, image->image);
    auto added = add(key, look, "emission", look.emission_picture, [](Image&) {});
    lay(*image, Look::emission_bit, look.emission_picture, look);
    return added;
  }

  /// Roughness and metallic in green and blue of one texture, occlusion in red of another, often of the same image.
  Expected<void> add_properties(const Json& material, Look& look) {
    const Json& dark_texture = member_of(material, "occlusionTexture");
    const auto rough =
        image_of(member_of(material, "pbrMetallicRoughness"), "metallicRoughnessTexture", look, "metallic-roughness");
    std::optional<Laid> dark;
    if (rough && material.contains("occlusionTexture") &&
        pictures_.mapping_of(dark_texture) !=
            pictures_.mapping_of(member_of(member_of(material, "pbrMetallicRoughness"), "metallicRoughnessTexture")))
      model_.left_out.push_back(
          fmt::format("material \"{}\" lays its occlusion texture otherwise than its metallic-roughness one, which is "
                      "not done: it is drawn without it",
                      look.name));
    else
      dark = image_of(material, "occlusionTexture", look, "occlusion");
    if (!rough && !dark) return {};
    auto added = add_packed(material, rough, dark, look);
    lay(rough ? *rough : *dark, Look::properties_bit, look.properties_picture, look);
    return added;
  }

  /// Adds one picture of both; at least one is there.
  Expected<void> add_packed(const Json& material, const std::optional<Laid>& rough_laid,
                            const std::optional<Laid>& dark_laid, Look& look) {
    const auto image_in = [](const std::optional<Laid>& laid) {
      return laid ? std::optional(laid->image) : std::optional<std::int64_t>();
    };
    const auto rough_image = image_in(rough_laid), dark_image = image_in(dark_laid);
    const Json& dark_texture = member_of(material, "occlusionTexture");
    const Json& texture =
        rough_image ? member_of(member_of(material, "pbrMetallicRoughness"), "metallicRoughnessTexture") : dark_texture;
    const float strength = share(number_in(dark_texture, "strength", 1.0));
    PictureKey key = key_of(texture, Use::properties, rough_image.value_or(-1));
    key.second_image = dark_image.value_or(-1);
    key.strength = dark_image ? strength : 0.0f;
    if (const auto known = pictures_.find(key)) {
      look.properties_picture = *known;
      return {};
    }
    std::optional<Image> rough, dark;
    if (rough_image) {
      auto picture = read(*rough_image, look, "metallic-roughness");
      if (!picture) return tl::unexpected(picture.error());
      rough = std::move(*picture);
    }
    if (dark_image && dark_image != rough_image) {
      auto picture = read(*dark_image, look, "occlusion");
      if (!picture) return tl::unexpected(picture.error());
      dark = std::move(*picture);
    }
    const Image* darkening = dark_image == rough_image ? (rough ? &*rough : nullptr) : (dark ? &*dark : nullptr);
    if (rough || darkening)
      look.properties_picture = pictures_.keep(key, properties_of(rough ? &*rough : nullptr, darkening, strength));
    return {};
  }

  Expected<void> add_normal(const Json& material, Look& look) {
    const auto image = image_of(material, "normalTexture", look, "normal");
    if (!image) return {};
    constexpr double most_scale = 100.0;
    const Json& texture = member_of(material, "normalTexture");
    const auto scale = static_cast<float>(std::clamp(number_in(texture, "scale", 1.0), -most_scale, most_scale));
    PictureKey key = key_of(texture, Use::normal, image->image);
    key.strength = scale;
    auto added = add(key, look, "normal", look.normal_picture, [&](Image& picture) {
      if (scale != 1.0f) scale_normals(picture, scale);
    });
    lay(*image, Look::normal_bit, look.normal_picture, look);
    return added;
  }

  /// The picture of one image, changed by `change`, as the look's `index`.
  template <class Change>
  Expected<void> add(const PictureKey& key, const Look& look, const char* what, std::int32_t& index, Change change) {
    if (const auto known = pictures_.find(key)) {
      index = *known;
      return {};
    }
    auto picture = read(key.image, look, what);
    if (!picture) return tl::unexpected(picture.error());
    if (!*picture) return {};
    change(**picture);
    index = pictures_.keep(key, std::move(**picture));
    return {};
  }

  const Container& container_;
  Model& model_;
  Pictures pictures_;
  std::optional<PictureMapping> mapping_, second_mapping_;  ///< Of the material that is read.
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
