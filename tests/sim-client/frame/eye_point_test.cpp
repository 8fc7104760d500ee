#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/world/instrument_panel.hpp"
#include "engine/world/interpolate.hpp"
#include "sim-client/frame/client_frame.hpp"
#include "tests/engine/rig/upper_right.hpp"
#include "tests/relative.hpp"
#include "tests/shipped_files.hpp"

namespace septet::frame {
namespace {

rig::Rig rig_of(const std::string& name) {
  auto rig = rig::read_rig(shipped_text("rigs/" + name + ".toml"), name);
  REQUIRE(rig);
  return *rig;
}

/// Place of a point of the car's frame on a view, fractions from its lower left as drawn before any flip.
Vec2 drawn_at(const instant::FrameView& view, const Vec3& point_m) {
  const glm::dvec4 clip = view.projection.clip_from_eye_relative * glm::dvec4(point_m - view.projection.eye_m, 1.0);
  REQUIRE(clip.w > 0.0);
  return {0.5 * (1.0 + clip.x / clip.w), 0.5 * (1.0 - clip.y / clip.w)};
}

/// Crossing of the straight line from the eye to the point with the window.
Vec2 passed_at(const rig::Window& window, const Vec3& eye_m, const Vec3& point_m) {
  const Vec3 right = window.lower_right_m - window.lower_left_m, up = window.upper_left_m - window.lower_left_m;
  const Vec3 back = glm::cross(right, up), way = point_m - eye_m;
  const Vec3 at = eye_m + way * (glm::dot(window.lower_left_m - eye_m, back) / glm::dot(way, back));
  return {glm::dot(at - window.lower_left_m, right) / glm::dot(right, right),
          glm::dot(at - window.lower_left_m, up) / glm::dot(up, up)};
}

}  // namespace

TEST_CASE("from wherever the head is each screen stays a window onto the same world") {
  const rig::Rig rig = rig_of("seven-screens");
  for (const Vec3& moved_m : {Vec3(0.0), Vec3(0.2, 0.1, -0.1), Vec3(-0.3, -0.3, 0.2)})
    for (const rig::Screen& screen : rig.screens) {
      const auto views = screen_views(rig, screen, {moved_m, 0.0});
      REQUIRE(views);
      const rig::Window& window = screen.views.front().window;
      const Vec3 beyond_m = 3.0 * (0.4 * window.lower_left_m + 0.6 * upper_right_m(window));
      const Vec2 drawn = drawn_at(views->views.front(), beyond_m);
      const Vec2 passed = passed_at(window, rig.eye_point_m + moved_m, beyond_m);
      CHECK(drawn.x == relative(passed.x, 1e-9));
      CHECK(drawn.y == relative(passed.y, 1e-9));
    }
}

TEST_CASE("whoever looks aside sees in the middle of the screen what lies aside and the mirrors where they are") {
  const rig::Rig rig = rig_of("desktop");
  const rig::Screen& screen = rig.screens.front();
  const double turn_rad = 0.7;
  const auto ahead = screen_views(rig, screen), aside = screen_views(rig, screen, {{}, turn_rad});
  REQUIRE(ahead);
  REQUIRE(aside);
  const Vec3 far_ahead_m = rig.eye_point_m + Vec3(100.0, 0.0, 0.0);
  const Vec3 far_aside_m = rig.eye_point_m + 100.0 * Vec3(std::cos(turn_rad), std::sin(turn_rad), 0.0);
  CHECK(glm::distance(drawn_at(ahead->views[0], far_ahead_m), drawn_at(aside->views[0], far_aside_m)) < 1e-9);
  CHECK(drawn_at(aside->views[0], far_ahead_m).x > 1.0);  // The point has gone out to the right.
  // A driver who looks there sees the left mirror at its place, and no second picture of it.
  CHECK(ahead->mirrors.empty());
  REQUIRE(aside->mirrors.size() == 1);
  CHECK(aside->mirrors[0].mirror.name == "left mirror");
  REQUIRE(ahead->views.size() == 4);
  REQUIRE(aside->views.size() == 3);
  for (const auto& [before, after] : {std::pair{1, 1}, {3, 2}}) {
    CHECK(ahead->views[before].mirrored);
    CHECK(ahead->views[before].projection.eye_m == aside->views[after].projection.eye_m);
    CHECK(ahead->views[before].projection.clip_from_eye_relative ==
          aside->views[after].projection.clip_from_eye_relative);
  }
}

TEST_CASE("a car behind and to the left is in the left mirror and one straight behind in the inside one") {
  const rig::Rig rig = rig_of("desktop");
  const auto views = screen_views(rig, rig.screens.front());
  REQUIRE(views);
  const auto shows = [&](const std::string& name, const Vec3& point_m) {
    for (std::size_t i = 0; i < views->views.size(); ++i) {
      const auto& mirror = rig.screens.front().views[i].mirror;
      if (!mirror || rig.mirrors[*mirror].name != name) continue;
      const Vec2 at = drawn_at(views->views[i], point_m);
      return at.x >= 0.0 && at.x <= 1.0 && at.y >= 0.0 && at.y <= 1.0;
    }
    return false;
  };
  const Vec3 left_lane(-12.0, 3.6, 0.8), same_lane(-30.0, 0.0, 0.8), right_lane(-12.0, -3.6, 0.8);
  CHECK(shows("left mirror", left_lane));
  CHECK_FALSE(shows("left mirror", right_lane));
  CHECK(shows("right mirror", right_lane));
  CHECK_FALSE(shows("right mirror", left_lane));
  CHECK(shows("inside mirror", same_lane));
}

TEST_CASE("a window of a few pixels has views of one pixel at least, all within it") {
  const rig::Rig rig = rig_of("desktop");
  rig::Screen screen = rig.screens.front();
  for (const std::uint32_t width_px : {1u, 2u, 5u, 2000u})
    for (const std::uint32_t height_px : {1u, 3u, 7u, 1100u}) {
      CAPTURE(width_px);
      CAPTURE(height_px);
      screen.width_px = width_px;
      screen.height_px = height_px;
      const auto views = screen_views(rig, screen);
      REQUIRE(views);
      for (const auto& view : views->views) {
        const auto& at = view.viewport;
        CHECK((at.x >= 0 && at.y >= 0 && at.width > 0 && at.height > 0));
        CHECK(at.x + std::int64_t{at.width} <= width_px);
        CHECK(at.y + std::int64_t{at.height} <= height_px);
      }
    }
}

TEST_CASE("between two ticks the head is between its two places") {
  Snapshot before, after;
  after.tick = 1;
  after.simulated_time_s = 0.5;
  after.driver_car.head = {{0.1, -0.2, 0.04}, 0.8};
  const Head half = interpolate(before, after, 0.25).driver_car.head;
  CHECK(half.from_rest_m.y == doctest::Approx(-0.1));
  CHECK(half.turn_rad == doctest::Approx(0.4));
  CHECK(interpolate(before, after, 0.5).driver_car.head == after.driver_car.head);
}

TEST_CASE("no inset lies on the dials, whichever way the driver looks") {
  namespace panel = instrument_panel;
  const rig::Rig rig = rig_of("desktop");
  const rig::Screen& screen = rig.screens.front();
  for (const Vec3& moved_m : {Vec3(0.0), Vec3(0.2, 0.1, -0.1), Vec3(-0.2, -0.1, 0.1)})
    for (double turn_rad = -1.2; turn_rad <= 1.2; turn_rad += 0.05) {
      CAPTURE(turn_rad);
      const auto views = screen_views(rig, screen, {moved_m, turn_rad});
      REQUIRE(views);
      const instant::OffAxisView& through = views->views.front().projection;
      for (std::size_t i = 1; i < views->views.size(); ++i) {
        const instant::PixelRectangle& inset = views->views[i].viewport;
        for (const double across : {-0.5, -0.3, 0.0, 0.3, 0.5})
          for (const double upward : {-0.5, 0.0, 0.5}) {
            const Vec3 at =
                panel::middle_m + across * panel::width_m * panel::right + upward * panel::height_m * panel::up;
            const glm::dvec4 clip = through.clip_from_eye_relative * glm::dvec4(at - through.eye_m, 1.0);
            if (clip.w < 1e-3) continue;
            const double x = (0.5 + 0.5 * clip.x / clip.w) * screen.width_px,
                         y = (0.5 + 0.5 * clip.y / clip.w) * screen.height_px;
            const bool on_inset =
                x > inset.x && x < inset.x + double(inset.width) && y > inset.y && y < inset.y + double(inset.height);
            CHECK_FALSE(on_inset);
          }
        CHECK(inset.y >= 0);
      }
    }
}

}  // namespace septet::frame
