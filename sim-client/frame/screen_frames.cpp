#include "sim-client/frame/screen_frames.hpp"

#include <initializer_list>
#include <utility>
#include <vector>

#include "engine/core/check.hpp"
#include "sim-client/frame/instruments.hpp"

namespace septet::frame {

Expected<void> ScreenFrames::look_through(const rig::Rig& rig, const rig::Screen& screen) {
  auto views = screen_views(rig, screen);
  if (!views) return tl::unexpected(views.error());
  rig_ = &rig;
  screen_ = &screen;
  views_ = std::move(*views);
  head_ = {};
  return {};
}

instant::FrameInput ScreenFrames::frame(const Snapshot& shown, const scene::ResolvedScene& scene,
                                        std::optional<std::string> message) {
  SEPTET_CHECK(screen_, "no screen is looked through at tick {}", shown.tick);
  // A snapshot from outside may name a place behind a screen: then the eyes stay where they were.
  if (const Head& head = shown.driver_car.head; head != head_)
    if (auto views = screen_views(*rig_, *screen_, head_ = head)) views_ = std::move(*views);
  instant::FrameInput input = client_frame(shown, views_, driver_viewpoint(shown), scene);
  if (!views_.only_instruments) effects_.add_to(input);
  if (message) {
    input.overlay.push_back(banner(std::move(*message), *screen_));
    return input;
  }
  for (const std::vector<instant::OverlayText>& texts :
       {instruments(shown, *rig_, *screen_), game_standing(shown, *rig_, *screen_)})
    input.overlay.insert(input.overlay.end(), texts.begin(), texts.end());
  return input;
}

}  // namespace septet::frame
