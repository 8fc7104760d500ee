/// Opens a window if there is a display (xvfb-run gives one) and presents into it.

#include <cstdlib>

#include <doctest/doctest.h>

#include "engine/render/renderer.hpp"
#include "engine/render/window.hpp"
#include "tests/engine/instant/reference_scene.hpp"
#include "tests/why_not.hpp"

namespace septet::render {

TEST_CASE("frames are presented into a window") {
  if (const char* display = std::getenv("DISPLAY"); !display || *display == '\0') {
    MESSAGE("skipped: there is no display");
    return;
  }
  Expected<Window> window = Window::open({"Septet test", 320, 200, std::nullopt});
  REQUIRE(window.has_value());
  Expected<Renderer> renderer =
      Renderer::create({320, 200, DevicePreference::software, true, Antialiasing::automatic, &*window});
  REQUIRE_MESSAGE(renderer.has_value(), why_not(renderer));
  const ReferenceScene reference = reference_scene({{}, false, 0});
  REQUIRE(renderer->upload(reference.scene).has_value());
  FrameInput input;
  input.environment = reference_day();
  for (int i = 0; i < 5; ++i) {
    window->poll();
    input.views = {forward_view({2.0 * i, 0, 0}, 320, 200)};
    REQUIRE(renderer->draw(input).has_value());
  }
  REQUIRE(renderer->resize(160, 100).has_value());
  input.views = {forward_view({0, 0, 0}, 160, 100)};
  REQUIRE(renderer->draw(input).has_value());
  CHECK_FALSE(window->should_close());
  CHECK_MESSAGE(renderer->statistics().validation_messages == 0, renderer->statistics().first_validation_message);
}

TEST_CASE("without a display opening a window says so") {
  if (std::getenv("DISPLAY") || std::getenv("WAYLAND_DISPLAY")) {
    MESSAGE("skipped: there is a display");
    return;
  }
  const Expected<Window> window = Window::open({});
  REQUIRE_FALSE(window.has_value());
  CHECK(window.error().where == "display");
}

}  // namespace septet::render
