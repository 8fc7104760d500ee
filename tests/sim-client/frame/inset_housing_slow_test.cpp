/// A mirror's picture that lies over the driver's view stands in a housing, as pixels.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "engine/image/image.hpp"
#include "sim-client/frame/client_frame.hpp"
#include "sim-client/frame/viewpoint.hpp"
#include "tests/sim-client/frame/cockpit_view.hpp"

namespace septet::frame {
namespace {

image::Image drawn(const rig::Screen& screen, const ScreenViews& views, const Snapshot& shown, bool housed,
                   const std::string& name) {
  instant::FrameInput input = client_frame(shown, views, driver_viewpoint(shown), vehicles_scene());
  for (instant::FrameView& view : input.views) view.housed = view.housed && housed;
  return drawn_picture(screen, std::move(input), name);
}

int brightest(const image::Color& color) { return std::max({color.red, color.green, color.blue}); }

}  // namespace

TEST_CASE("a mirror over the view has a dark frame with rounded corners and a foot on the screen's edge") {
  const rig::Rig rig = rig_called("desktop");
  const rig::Screen& screen = rig.screens.front();
  const Snapshot shown = in_the_seat();
  const auto views = screen_views(rig, screen);
  REQUIRE(views.has_value());
  REQUIRE(views->views.size() == 4);
  const image::Image housed = drawn(screen, *views, shown, true, "housed"),
                     bare = drawn(screen, *views, shown, false, "bare");
  for (std::size_t n = 1; n < views->views.size(); ++n) {
    CAPTURE(n);
    const instant::PixelRectangle& inset = views->views[n].viewport;
    const auto at = [&](const image::Image& picture, double across, double down) {
      return picture.at(static_cast<std::uint32_t>(inset.x + across), static_cast<std::uint32_t>(inset.y + down));
    };
    const double w = inset.width, h = inset.height;
    // Its picture is left as it is but for the corners, which are cut.
    for (const auto& [across, down] : {std::pair{0.5 * w, 0.5 * h}, {2.0, 0.5 * h}, {0.5 * w, 2.0}, {w - 3.0, 0.5 * h}})
      CHECK(at(housed, across, down) == at(bare, across, down));
    for (const double across : {1.0, w - 2.0})
      for (const double down : {1.0, h - 2.0}) CHECK(brightest(at(housed, across, down)) < 60);
    // The frame beside it, and nothing beyond the frame's own corners.
    for (const auto& [across, down] :
         {std::pair{-3.0, 0.5 * h}, {w + 2.0, 0.5 * h}, {0.5 * w, h + 2.0}, {0.5 * w, -3.0}})
      CHECK(brightest(at(housed, across, down)) < 60);
    const double frame = std::round(0.085 * std::min(w, h));
    CHECK(at(housed, -frame, -frame) == at(bare, -frame, -frame));
    CHECK(at(housed, w + frame - 1.0, h + frame - 1.0) == at(bare, w + frame - 1.0, h + frame - 1.0));
  }
  // Feet: the inside mirror's on the upper edge, the side mirrors' on those beside them.
  const instant::PixelRectangle &inside = views->views[1].viewport, &left = views->views[2].viewport,
                                &right = views->views[3].viewport;
  const auto dark = [&](double x, double y) {
    return brightest(housed.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y))) < 60;
  };
  CHECK(dark(inside.x + 0.5 * inside.width, 1.0));
  CHECK(dark(1.0, left.y + 0.7 * left.height));
  CHECK(dark(screen.width_px - 2.0, right.y + 0.7 * right.height));
}

}  // namespace septet::frame
