#include "engine/raytrace/displayed.hpp"

#include <cmath>
#include <cstdint>

#include "engine/light/tone_curve.hpp"

namespace septet::raytrace {

image::Image displayed(const TracedPicture& picture, const instant::Exposure& exposure) {
  image::Image image(picture.width, picture.height);
  const float scale = exposure.scale();
  for (std::size_t n = 0; n < picture.pixels.size(); ++n) {
    const glm::vec3 code = glm::clamp(light::display_code(picture.pixels[n].radiance * scale), 0.0f, 1.0f);
    for (int c = 0; c < 3; ++c)
      image.rgba[4 * n + static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(std::lround(255.0f * code[c]));
  }
  return image;
}

}  // namespace septet::raytrace
