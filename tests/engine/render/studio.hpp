#pragma once
/// Small picture of the reference road, and measurements in it.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include <doctest/doctest.h>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/render/renderer.hpp"
#include "tests/engine/instant/reference_scene.hpp"

namespace septet::render::studio_pictures {

inline constexpr std::uint32_t width = 320, height = 200;

/// Reference road with a test's additions. Software device, validation layer on, which must be silent.
struct Studio {
  Renderer renderer;
  ReferenceScene reference;
  FrameInput input;

  explicit Studio(const ReferenceOptions& options = {{}, false, 0}, Antialiasing antialiasing = Antialiasing::automatic)
      : renderer(*Renderer::create({width, height, DevicePreference::software, true, antialiasing, nullptr})),
        reference(reference_scene(options)) {
    REQUIRE(renderer.upload(reference.scene).has_value());
    input.environment = reference_day();
    input.views = {forward_view(options.origin_m, width, height)};
  }
  ~Studio() {
    CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
  }
  image::Image draw() {
    REQUIRE(renderer.draw(input).has_value());
    return *renderer.read_back();
  }
};

/// Mean colour of a rectangle, codes 0 to 255.
inline glm::dvec3 mean(const image::Image& picture, std::uint32_t x, std::uint32_t y, std::uint32_t w,
                       std::uint32_t h) {
  glm::dvec3 sum(0.0);
  for (std::uint32_t j = y; j < y + h; ++j)
    for (std::uint32_t i = x; i < x + w; ++i) {
      const image::Color c = picture.at(i, j);
      sum += glm::dvec3(c.red, c.green, c.blue);
    }
  return sum / (double(w) * h);
}

/// Level of a colour, codes.
inline double level(const glm::dvec3& color) { return (color.r + color.g + color.b) / 3.0; }

/// Mean over all codes, alpha's too.
inline double mean_difference(const image::Image& a, const image::Image& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) sum += std::abs(int(a.rgba[i]) - int(b.rgba[i]));
  return sum / static_cast<double>(a.rgba.size());
}

/// Pixel of a world point in the picture.
inline glm::dvec2 pixel_of(const FrameView& view, const Vec3& world_m) {
  const Vec3 car_m = inverse(view.world_from_car) * world_m;
  const glm::dvec4 clip = view.projection.clip_from_eye_relative * glm::dvec4(car_m - view.projection.eye_m, 1.0);
  return {(0.5 + 0.5 * clip.x / clip.w) * view.viewport.width, (0.5 + 0.5 * clip.y / clip.w) * view.viewport.height};
}

}  // namespace septet::render::studio_pictures
