#pragma once
/// Pictures of a file's textures (glTF 2.0, 3.8), and how they lie on triangles (3.9.2 and KHR_texture_transform).

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "engine/core/expected.hpp"
#include "engine/gltf/container.hpp"
#include "engine/gltf/gltf.hpp"

namespace septet::gltf {

/// Ways in which a picture goes on beyond its edges (3.8.4.5); any other repeats.
inline constexpr std::int64_t clamped = 33071, mirrored = 33648;

struct Wrapping {
  std::int64_t u = 0, v = 0;
  bool operator==(const Wrapping&) const = default;
};

/// What a picture is made of: its purpose, its images, their strength and which way it is mirrored.
struct PictureKey {
  enum class Use : std::uint8_t { base_color, cut_out, blended, emission, properties, normal };
  Use use = Use::base_color;
  std::int64_t image = -1, second_image = -1;
  float strength = 1.0f;
  Wrapping wrapping{};
  bool is_sharp = false;
  auto operator<=>(const PictureKey& other) const {
    const auto all = [](const PictureKey& key) {
      return std::tuple(key.use, key.image, key.second_image, key.strength, key.wrapping.u, key.wrapping.v,
                        key.is_sharp);
    };
    return all(*this) <=> all(other);
  }
};

/// Decodes pictures and keeps each that is made once.
class Pictures {
 public:
  /// Both outlive this.
  Pictures(const Container& container, Model& model) : container_(container), model_(model) {}

  /// Index of a texture's image in the file; empty where it names none.
  std::optional<std::int64_t> image_of(const Json& texture) const;
  /// How it lies: textures that lie alike can share a triangle's coordinates.
  PictureMapping mapping_of(const Json& texture) const;
  Wrapping wrapping_of(const Json& texture) const;
  /// True where its sampler asks for the nearest pixel instead of a mean of four.
  bool is_sharp(const Json& texture) const;

  /// An image of the file. Empty where it is of an unsupported kind, which is then reported with `instead`: what is
  /// drawn without it. Error: a damaged or too large image.
  Expected<std::optional<image::Image>> read(std::int64_t image, const std::string& instead);

  /// Index among the model's of a picture that is already there.
  std::optional<std::int32_t> find(const PictureKey& key) const;
  /// The same of a new one, reduced to the size that is drawn, and with its mirror image where it is mirrored.
  std::int32_t keep(const PictureKey& key, image::Image picture);

 private:
  const Json& sampler_of(const Json& texture) const;

  const Container& container_;
  Model& model_;
  std::size_t pixels_ = 0;
  std::map<PictureKey, std::int32_t> kept_;
};

}  // namespace septet::gltf
