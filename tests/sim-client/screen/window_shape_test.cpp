#include "sim-client/screen/window_shape.hpp"

#include <cmath>
#include <string>
#include <utility>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/relative.hpp"
#include "tests/shipped_files.hpp"

namespace septet::screen {
namespace {

rig::Rig rig_called(const std::string& name) {
  auto rig = rig::read_rig(shipped_text("rigs/" + name + ".toml"), name);
  REQUIRE(rig);
  return *rig;
}

double width_m(const rig::Window& window) { return glm::distance(window.lower_left_m, window.lower_right_m); }
double height_m(const rig::Window& window) { return glm::distance(window.lower_left_m, window.upper_left_m); }
Vec3 middle_m(const rig::Window& window) { return 0.5 * (window.lower_right_m + window.upper_left_m); }

/// Metres across over metres upward, over the same of its pixels: 1 where a circle is a circle.
double squareness(const rig::Screen& screen) {
  const rig::Window& window = screen.views.front().window;
  return width_m(window) / height_m(window) / (double(screen.width_px) / screen.height_px);
}

}  // namespace

TEST_CASE("a desktop's window of any shape shows the world undistorted, its height as the rig has it") {
  const rig::Rig rig = rig_called("desktop");
  const rig::Screen& desktop = rig.screens.front();
  for (const auto& [width_px, height_px] : {std::pair{1280u, 747u},
                                            {1920u, 1080u},
                                            {1880u, 700u},
                                            {500u, 900u},
                                            {3440u, 1440u},
                                            {1080u, 1920u},
                                            {640u, 374u}}) {
    const auto wide = width_px;
    CAPTURE(wide);
    const rig::Screen shaped = shaped_to_window(desktop, rig.eye_point_m, width_px, height_px);
    CHECK(shaped.width_px == width_px);
    CHECK(shaped.height_px == height_px);
    CHECK(squareness(shaped) == relative(squareness(desktop), 1e-9));
    CHECK(height_m(shaped.views.front().window) == relative(height_m(desktop.views.front().window), 1e-9));
    CHECK(glm::distance(middle_m(shaped.views.front().window), middle_m(desktop.views.front().window)) < 1e-9);
    for (std::size_t i = 1; i < shaped.views.size(); ++i) {
      const rig::View &was = desktop.views[i], &now = shaped.views[i];
      const double was_aspect = was.width * desktop.width_px / (was.height * desktop.height_px);
      CHECK(now.width * width_px / (now.height * height_px) == relative(was_aspect, 1e-9));
      CHECK(now.width <= was.width + 1e-12);
      CHECK(now.height <= was.height + 1e-12);
      CHECK(now.left >= 0.0);
      CHECK(now.left + now.width <= 1.0);
      CHECK(now.top + now.height <= 1.0);
    }
  }
}

TEST_CASE("a window as wide as a ribbon sees no wider than eyes can, still undistorted") {
  const rig::Rig rig = rig_called("desktop");
  for (const auto& [width_px, height_px] : {std::pair{5000u, 300u}, {16000u, 10u}, {3000u, 1u}}) {
    const rig::Screen shaped = shaped_to_window(rig.screens.front(), rig.eye_point_m, width_px, height_px);
    const rig::Window& window = shaped.views.front().window;
    CHECK(squareness(shaped) == relative(squareness(rig.screens.front()), 1e-9));
    const double half_rad = std::atan(0.5 * width_m(window) / glm::distance(middle_m(window), rig.eye_point_m));
    CHECK(2.0 * half_rad <= widest_rad + 1e-9);
  }
  const rig::Screen none = shaped_to_window(rig.screens.front(), rig.eye_point_m, 0, 0);
  CHECK(none.width_px == 1);
  CHECK(std::isfinite(width_m(none.views.front().window)));
}

TEST_CASE("screens whose place was measured keep their corners, whatever shape their window has") {
  for (const char* name : {"three-monitors", "seven-screens"}) {
    const rig::Rig rig = rig_called(name);
    for (const rig::Screen& screen : rig.screens) CHECK_FALSE(takes_window_shape(rig, screen));
  }
  rig::Rig desk = rig_called("desktop");
  CHECK(takes_window_shape(desk, desk.screens.front()));
  rig::Screen panel = desk.screens.front();
  panel.only_instruments = true;
  desk.screens.push_back(panel);
  CHECK(takes_window_shape(desk, desk.screens.front()));
  CHECK(takes_window_shape(desk, desk.screens.back()));
  desk.screens.front().full_screen = true;
  CHECK_FALSE(takes_window_shape(desk, desk.screens.front()));
  desk.screens.front().full_screen = desk.screens.front().show_interior = false;
  CHECK_FALSE(takes_window_shape(desk, desk.screens.front()));
}

}  // namespace septet::screen
