#include "sim-client/frame/screen_frames.hpp"

#include <utility>
#include <vector>

#include "engine/core/check.hpp"
#include "sim-client/frame/instruments.hpp"

namespace septet::frame {

Expected<void> ScreenFrames::look_through(const rig::Rig& rig, const rig::Screen& screen, std::optional<Eyes> eyes) {
  auto views = screen_views(rig, screen);
  if (!views) return tl::unexpected(views.error());
  rig_ = &rig;
  screen_ = &screen;
  views_ = std::move(*views);
  head_ = {};
  eyes_ = std::move(eyes);
  last_place_.reset();
  return {};
}

ScreenViews ScreenFrames::views_in(const Snapshot& shown, const Viewpoint& viewpoint, bool are_drivers) const {
  ScreenViews views = views_;
  if (are_drivers || views.only_instruments) return views;
  views.views.resize(1);  // Insets are mirrors of the driver's car.
  // The rig's real car is around the viewer and stands for the driver's; others' pillars hide other things.
  views.show_interior |= viewpoint.inside != shown.driver_car.participant;
  return views;
}

instant::FrameInput ScreenFrames::frame(const Snapshot& shown, const scene::ResolvedScene& scene,
                                        std::optional<std::string> message) {
  SEPTET_CHECK(screen_, "no screen is looked through at tick {}", shown.tick);
  const bool are_drivers = !eyes_ || eyes_->participant == shown.driver_car.participant;
  Head head;
  if (are_drivers) head = shown.driver_car.head;
  if (are_drivers && eyes_) head.turn_rad = shown.driver_car.gaze_heading_rad;
  // A snapshot from outside may name a place behind a screen: then the eyes stay where they were.
  if (head != head_)
    if (auto views = screen_views(*rig_, *screen_, head_ = head)) views_ = std::move(*views);
  const auto theirs = are_drivers ? std::nullopt : viewpoint_of(shown, eyes_->participant, rig_->eye_point_m);
  if (theirs) last_place_ = theirs;
  Viewpoint viewpoint = driver_viewpoint(shown);
  if (!are_drivers && last_place_) viewpoint = *last_place_;
  instant::FrameInput input = client_frame(shown, views_in(shown, viewpoint, are_drivers), viewpoint, scene);
  if (!views_.only_instruments) effects_.add_to(input);
  if (message) {
    input.overlay.push_back(banner(std::move(*message), *screen_));
    return input;
  }
  const auto add = [&](const std::vector<instant::OverlayText>& texts) {
    input.overlay.insert(input.overlay.end(), texts.begin(), texts.end());
  };
  if (eyes_)
    add(eyes_caption(eyes_->name,
                     are_drivers ? EyesSeen::drivers
                     : theirs    ? EyesSeen::others
                                 : EyesSeen::absent,
                     *rig_, *screen_));
  // Speed, gear and points are the driver's.
  if (!are_drivers) return input;
  add(instruments(shown, *rig_, *screen_));
  add(guidance_texts(shown, *rig_, *screen_));
  add(game_standing(shown, *rig_, *screen_));
  return input;
}

}  // namespace septet::frame
