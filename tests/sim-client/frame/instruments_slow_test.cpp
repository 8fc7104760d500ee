/// Instruments and the table of keys as pixels of a frame. Software device.

#include <cstdlib>

#include <doctest/doctest.h>

#include "engine/image/png.hpp"
#include "engine/render/renderer.hpp"
#include "sim-client/frame/instruments.hpp"
#include "tests/shipped_files.hpp"

namespace septet::frame {
namespace {

struct Size {
  std::uint32_t width_px, height_px;
};

rig::Rig desktop(std::uint32_t width_px, std::uint32_t height_px) {
  rig::Rig rig = *rig::read_rig(shipped_text("rigs/desktop.toml"), "desktop");
  rig.screens[0].width_px = width_px;
  rig.screens[0].height_px = height_px;
  rig.screens[0].show_interior = false;  // Without the interior, whose dials show all but the stalled engine.
  return rig;
}

Snapshot driving() {
  Snapshot snapshot;
  snapshot.participants.push_back({.id = 1});
  snapshot.participants[0].lamps.set(Lamp::indicator_left, true);
  snapshot.driver_car = {.participant = 1, .speed_mps = 30.0, .engine_radps = 0.0, .gear = 5};
  return snapshot;
}

/// Picture of the overlay alone, without a world. SEPTET_PICTURES: a folder for keeping it for people.
image::Image draw(const rig::Screen& screen, const std::vector<instant::OverlayText>& texts, const std::string& name) {
  auto renderer = render::Renderer::create(
      {.width = screen.width_px, .height = screen.height_px, .device = render::DevicePreference::software});
  REQUIRE(renderer.has_value());
  instant::FrameInput input;
  input.views.push_back({.projection = instant::symmetric_view(Vec3(1.35, 0.37, 1.17), 0.0, 0.0, 0.77, 0.52),
                         .viewport = {0, 0, screen.width_px, screen.height_px}});
  input.overlay = texts;
  REQUIRE(renderer->draw(input).has_value());
  const auto picture = renderer->read_back();
  REQUIRE(picture.has_value());
  if (const char* folder = std::getenv("SEPTET_PICTURES"))
    CHECK(image::write_png(std::string(folder) + "/" + name + ".png", *picture).has_value());
  return *picture;
}

/// Number of pixels of about this colour in the rows from `top` to `bottom` (shares of the height).
template <class Like>
int count(const image::Image& picture, double top, double bottom, Like like) {
  int found = 0;
  for (auto y = static_cast<std::uint32_t>(top * picture.height);
       y < static_cast<std::uint32_t>(bottom * picture.height); ++y)
    for (std::uint32_t x = 0; x < picture.width; ++x) found += like(picture.at(x, y));
  return found;
}

bool is_white(const image::Color& c) { return c.red > 220 && c.green > 220 && c.blue > 220; }
bool is_green(const image::Color& c) { return c.green > 200 && c.red < 120; }
bool is_red(const image::Color& c) { return c.red > 180 && c.green < 140 && c.blue < 130; }

}  // namespace

TEST_CASE("the instruments are drawn in the lower part of the picture at any size") {
  for (const Size size : {Size{1280, 747}, {320, 200}, {160, 120}}) {
    const std::uint32_t width_px = size.width_px, height_px = size.height_px;
    CAPTURE(width_px);
    const rig::Rig rig = desktop(width_px, height_px);
    const auto picture =
        draw(rig.screens[0], instruments(driving(), rig, rig.screens[0]), "instruments-" + std::to_string(width_px));
    CHECK(count(picture, 0.8, 1.0, is_white) > 30);
    CHECK(count(picture, 0.8, 1.0, is_green) > 5);
    CHECK(count(picture, 0.8, 1.0, is_red) > 10);
    const auto without = draw(rig.screens[0], {}, "nothing");
    for (std::uint32_t y = 0; y < static_cast<std::uint32_t>(0.75 * height_px); y += 7)
      for (std::uint32_t x = 0; x < width_px; x += 7) REQUIRE(picture.at(x, y) == without.at(x, y));
  }
}

TEST_CASE("the table of keys is drawn whole") {
  for (const Size size : {Size{1280, 747}, {1920, 1080}, {480, 300}}) {
    const std::uint32_t width_px = size.width_px, height_px = size.height_px;
    CAPTURE(width_px);
    const rig::Rig rig = desktop(width_px, height_px);
    const auto texts = key_table("Press any key to start", rig.screens[0]);
    const auto picture = draw(rig.screens[0], texts, "keys-" + std::to_string(width_px));
    // Every line of it has letters: all found room in the atlas.
    for (const auto& text : texts) {
      CAPTURE(text.text);
      int bright = 0;
      for (auto y = static_cast<std::uint32_t>(text.y_px); y < static_cast<std::uint32_t>(text.y_px + text.height_px);
           ++y)
        for (std::uint32_t x = static_cast<std::uint32_t>(text.x_px) -
                               (text.centered ? 4 * static_cast<std::uint32_t>(text.height_px) : 0),
                           i = 0;
             i < 6 * static_cast<std::uint32_t>(text.height_px); ++i)
          bright += x + i < width_px && picture.at(x + i, y).red > 130;
      CHECK(bright > 5);
    }
  }
}

}  // namespace septet::frame
