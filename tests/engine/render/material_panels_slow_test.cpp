/// A panel for each of the sixteen kinds of fragment, by the rasteriser and by the ray tracer, beside a reference on the
/// CPU. Software device, validation layer on.
///
/// Light is taken out by two more pictures of the same panels, with everything and with nothing of what each shows: at
/// every pixel (panel − nothing) / (everything − nothing) is the tree's value there.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <doctest/doctest.h>
#include <glm/common.hpp>

#include "engine/image/png.hpp"
#include "engine/image/srgb.hpp"
#include "engine/render/renderer.hpp"
#include "tests/checkout.hpp"
#include "tests/engine/instant/two_sided_plate.hpp"
#include "tests/engine/raytrace/traced_scenes.hpp"
#include "tests/engine/render/material_panels.hpp"

namespace septet::render::fragments {
namespace {

constexpr std::uint32_t panel_px = 16, picture_px = 4 * panel_px;
using Radiance = std::vector<glm::vec3>;

instant::FrameInput panel_input() {
  instant::FrameInput input;
  input.environment = instant::plate_day();
  input.views = {instant::plate_view(picture_px)};
  return input;
}

Radiance rasterised_panels(const ResolvedScene& scene) {
  Renderer renderer =
      *Renderer::create({picture_px, picture_px, DevicePreference::software, true, Antialiasing::none, nullptr});
  REQUIRE(renderer.upload(scene).has_value());
  REQUIRE(renderer.draw(panel_input()).has_value());
  CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
  return renderer.read_radiance()->radiance;
}

Radiance traced_panels(const ResolvedScene& scene) {
  const raytrace::TracedPicture picture = raytrace::traced(
      scene, instant::describe(panel_input(), instant::summarise(scene)), {.samples = 1024, .seed = 3});
  Radiance radiance;
  radiance.reserve(picture.pixels.size());
  for (const raytrace::TracedPixel& pixel : picture.pixels) radiance.push_back(pixel.radiance);
  return radiance;
}

/// Values of the trees at each pixel.
template <class Draw>
Radiance values_by(const Draw& draw) {
  Radiance own = draw(panel_scene(Trees::own));
  const Radiance full = draw(panel_scene(Trees::full)), nothing = draw(panel_scene(Trees::nothing));
  for (std::size_t i = 0; i < own.size(); ++i) own[i] = (own[i] - nothing[i]) / (full[i] - nothing[i]);
  return own;
}

Radiance reference_values() {
  Radiance values(std::size_t{picture_px} * picture_px);
  const std::vector<Panel> all = panels(no_node);
  constexpr int fine = 4;
  for (std::uint32_t y = 0; y < picture_px; ++y)
    for (std::uint32_t x = 0; x < picture_px; ++x)
      for (int k = 0; k < fine * fine; ++k) {
        const auto at = [](std::uint32_t pixel, int step) {
          return (static_cast<float>(pixel % panel_px) + (static_cast<float>(step) + 0.5f) / fine) / panel_px;
        };
        values[y * picture_px + x] += all[y / panel_px * 4 + x / panel_px].reference(at(x, k % fine), at(y, k / fine)) /
                                      static_cast<float>(fine * fine);
      }
  return values;
}

/// The mean over the inner four pixels of a sixteenth of a panel.
glm::vec3 sixteenth(const Radiance& values, std::size_t panel, std::size_t part) {
  glm::vec3 sum(0.0f);
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t x = panel % 4 * panel_px + part % 4 * 4 + 1 + k % 2,
                      y = panel / 4 * panel_px + part / 4 * 4 + 1 + k / 2;
    sum += values[y * picture_px + x] / 4.0f;
  }
  return sum;
}

/// The greatest difference from the reference over a panel, of any channel.
float farthest_off(const Radiance& values, const Radiance& reference, std::size_t panel) {
  float most = 0.0f;
  for (std::size_t part = 0; part < 16; ++part) {
    const glm::vec3 off = glm::abs(sixteenth(values, panel, part) - sixteenth(reference, panel, part));
    for (int c = 0; c < 3; ++c)
      if (!(off[c] <= most)) most = off[c];  // NaN counts.
  }
  return most;
}

/// Rasterised, traced, reference, from the left; six times as large.
void write_panels(const std::array<const Radiance*, 3>& pictures) {
  constexpr std::uint32_t large = 6;
  image::Image picture(3 * picture_px * large, picture_px * large);
  for (std::uint32_t y = 0; y < picture.height; ++y)
    for (std::uint32_t x = 0; x < picture.width; ++x) {
      const Radiance& values = *pictures[x / (picture_px * large)];
      const glm::vec3 value = values[y / large * picture_px + x / large % picture_px];
      std::uint8_t* p = &picture.rgba[4 * (std::size_t{y} * picture.width + x)];
      for (int c = 0; c < 3; ++c)
        p[c] = static_cast<std::uint8_t>(255.0f * image::srgb_of_light(glm::clamp(value[c], 0.0f, 1.0f)));
    }
  image::write_png(build_folder() + "/images/material panels.png", picture);
}

}  // namespace

TEST_CASE("each of the sixteen fragments gives its tree's picture, rasterised and traced") {
  const Radiance rasterised = values_by(rasterised_panels), traced = values_by(traced_panels);
  const Radiance reference = reference_values();
  write_panels({&rasterised, &traced, &reference});
  const std::vector<Panel> all = panels(no_node);
  REQUIRE(all.size() == std::variant_size_v<Fragment>);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const float raster_off = farthest_off(rasterised, reference, i), traced_off = farthest_off(traced, reference, i);
    MESSAGE(all[i].name, ": rasterised ", raster_off, ", traced ", traced_off);
    CAPTURE(all[i].name);
    CHECK(raster_off < 0.01f);
    CHECK(traced_off < (all[i].shows == Shows::opacity ? 0.03f : 0.02f));
  }
}

}  // namespace septet::render::fragments
