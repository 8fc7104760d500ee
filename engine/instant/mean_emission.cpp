#include "engine/instant/mean_emission.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/image/srgb.hpp"

namespace septet::instant {
namespace {

glm::vec3 mean_of(const scene::TextureImage& image) {
  std::array<std::array<std::uint64_t, 256>, 3> counts{};
  for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4)
    for (std::size_t c = 0; c < 3; ++c) ++counts[c][image.rgba[i + c]];
  const std::size_t count = image.rgba.size() / 4;
  if (count == 0) return glm::vec3(1.0f);
  const auto pixels = static_cast<double>(count);
  std::array<double, 3> sums{};
  for (std::size_t code = 0; code < 256; ++code) {
    const double share = static_cast<double>(code) / 255.0;
    const double light = image.srgb ? image::light_of_srgb(share) : share;
    for (std::size_t c = 0; c < 3; ++c) sums[c] += light * static_cast<double>(counts[c][code]);
  }
  return {sums[0] / pixels, sums[1] / pixels, sums[2] / pixels};
}

}  // namespace

std::vector<glm::vec3> mean_emissions(const scene::ResolvedScene& scene) {
  std::vector<glm::vec3> emissions;
  emissions.reserve(scene.materials.size());
  for (const scene::SurfaceMaterial& material : scene.materials) {
    emissions.push_back(material.emission);
    const std::int32_t image = material.maps[scene::SurfaceMap::emission];
    if (image >= 0 && static_cast<std::size_t>(image) < scene.images.size() && material.emission != glm::vec3(0.0f))
      emissions.back() *= mean_of(scene.images[static_cast<std::size_t>(image)]);
  }
  return emissions;
}

}  // namespace septet::instant
