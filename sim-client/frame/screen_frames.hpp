#pragma once
/// What one screen of a rig draws, frame by frame: the world through its window, the car around the eyes, effects, what the driver reads.
///
/// septet-screen draws these frames, and so do the golden pictures: what is compared is what a client shows.

#include <optional>
#include <string>

#include "sim-client/frame/client_frame.hpp"
#include "sim-client/frame/effects_drawing.hpp"

namespace septet::frame {

class ScreenFrames {
 public:
  /// From now on of this screen; both outlive that. Refuses a screen that the eyes do not see from its front.
  Expected<void> look_through(const rig::Rig& rig, const rig::Screen& screen);
  /// Takes the effects that an instant shows, by the keyframes around it in `history`.
  void show(const Snapshot& instant, const TickHistory& history, double tick_s, const scene::ResolvedScene& scene) {
    effects_.show(instant, history, tick_s, scene);
  }
  /// Of a screen that is looked through. The effects are those that were shown last. `message`: across the middle, instead of instruments.
  instant::FrameInput frame(const Snapshot& shown, const scene::ResolvedScene& scene,
                            std::optional<std::string> message = std::nullopt);

 private:
  const rig::Rig* rig_ = nullptr;
  const rig::Screen* screen_ = nullptr;
  ScreenViews views_;
  Head head_;  ///< For which the views are.
  EffectsDrawing effects_;
};

}  // namespace septet::frame
